//! What is refused, and with which number.
