//! The direction of the commanded points.

use profiles::Real;

use super::frame::PathFrame;

/// The last commanded point and the direction that led to it: the memory of a contour error from commanded points.
///
/// A point that repeats the last one keeps the direction, so that a reference that comes to rest does not turn its lag
/// into contour error from one tick to the next. Before two points differ there is no direction.
///
/// ```
/// use control::{CommandedPath, ContourBasis, ContourError};
///
/// let mut path = CommandedPath::new();
/// assert_eq!(path.update([0.0, 0.0]), None);
/// let frame = path.update([1.0, 0.0]);
/// assert_eq!(ContourError::new([0.5, 0.25], frame.as_ref())?.vector(), [0.0, 0.25]);
/// // At rest, and where a point is lost, the direction stays.
/// assert_eq!(path.update([1.0, 0.0]), frame);
/// assert_eq!(path.update([f64::NAN, 0.0]), frame);
/// # Ok::<(), control::ContourFault>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CommandedPath<const N: usize, F = f64> {
    point: Option<[F; N]>,
    frame: Option<PathFrame<N, F>>,
}

impl<const N: usize, F: Real> CommandedPath<N, F> {
    /// No point yet.
    #[must_use]
    pub fn new() -> Self {
        Self { point: None, frame: None }
    }

    /// Takes the next commanded point; the line that leads to it, or the last there was. A point that is not finite
    /// changes nothing.
    #[inline]
    pub fn update(&mut self, point: [F; N]) -> Option<PathFrame<N, F>> {
        if let Ok(frame) = PathFrame::between(self.point.unwrap_or(point), point) {
            self.point = Some(point);
            if frame.is_some() {
                self.frame = frame;
            }
        }
        self.frame
    }

    /// The last direction there was.
    #[must_use]
    pub fn frame(&self) -> Option<&PathFrame<N, F>> {
        self.frame.as_ref()
    }
}

impl<const N: usize, F: Real> Default for CommandedPath<N, F> {
    fn default() -> Self {
        Self::new()
    }
}
