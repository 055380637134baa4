//! Points and derivatives of curves.
fn main() {}
