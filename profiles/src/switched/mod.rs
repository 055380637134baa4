//! Motions of constant jerk between switches, by the conditions that determine the switches.

mod motion;
mod newton;
mod states;
mod zero;

pub use states::{Condition, SwitchState};
pub use zero::Zero;

/// A stretch of constant jerk.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Arc {
    /// Jerk, m/s^3.
    pub jerk: f64,
    /// Duration, s.
    pub duration: f64,
}

/// A place where a motion meets a limit, by the index of an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Contact {
    /// The acceleration at the start of an arc, m/s^2.
    Acceleration {
        /// Index of the arc.
        arc: usize,
        /// The limit that it meets.
        value: f64,
    },
    /// The velocity at the start of an arc, m/s.
    Velocity {
        /// Index of the arc.
        arc: usize,
        /// The limit that it meets.
        value: f64,
    },
    /// The velocity where the acceleration crosses zero within an arc, m/s.
    Turn {
        /// Index of the arc.
        arc: usize,
        /// The limit that it meets.
        value: f64,
    },
}

impl Contact {
    /// Index of the arc.
    #[must_use]
    pub fn arc(&self) -> usize {
        match *self {
            Self::Acceleration { arc, .. } | Self::Velocity { arc, .. } | Self::Turn { arc, .. } => arc,
        }
    }

    /// The same contact at another arc.
    #[must_use]
    pub fn moved(self, arc: usize) -> Self {
        match self {
            Self::Acceleration { value, .. } => Self::Acceleration { arc, value },
            Self::Velocity { value, .. } => Self::Velocity { arc, value },
            Self::Turn { value, .. } => Self::Turn { arc, value },
        }
    }
}

/// Where a motion ends: without acceleration, at a velocity, and for a move at a distance.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Goal {
    /// Velocity at the end, m/s.
    pub velocity: f64,
    /// Distance at the end, m; none for a change of velocity, which takes the way it takes.
    pub distance: Option<f64>,
}

/// A motion of constant jerk between switches, of at most `N` arcs.
///
/// A time-optimal motion within limits is of this kind: full jerk up or down, or none where a limit is met. Which follows
/// which is its structure; the durations of the arcs are then determined by conditions, one for each: how the motion
/// ends, which poles its jerk must not excite ([`Zero`]), and which limits it meets where ([`Contact`]). For small
/// changes of what is asked the structure stays, and [`Switched::corrected`] solves the conditions anew.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Switched<const N: usize> {
    arcs: [Arc; N],
    len: usize,
    /// Velocity before the start, m/s.
    from: f64,
}

impl<const N: usize> Switched<N> {
    /// A motion from the velocity `from`, m/s, through `arcs`; none where there are more than `N` of them or a number is
    /// not finite. A negative duration is taken algebraically: the motion goes back in time.
    #[must_use]
    pub fn new(from: f64, arcs: &[Arc]) -> Option<Self> {
        let mut all = [Arc::default(); N];
        all.get_mut(..arcs.len())?.copy_from_slice(arcs);
        let good = |arc: &Arc| arc.jerk.is_finite() && arc.duration.is_finite();
        (from.is_finite() && arcs.iter().all(good)).then_some(Self { arcs: all, len: arcs.len(), from })
    }

    /// The arcs, in the order of time.
    #[must_use]
    pub fn arcs(&self) -> &[Arc] {
        self.arcs.get(..self.len).unwrap_or_default()
    }

    fn arcs_mut(&mut self) -> &mut [Arc] {
        self.arcs.get_mut(..self.len).unwrap_or_default()
    }

    /// Velocity before the start, m/s.
    #[must_use]
    pub fn start_velocity(&self) -> f64 {
        self.from
    }

    /// Sum of the durations, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.arcs().iter().map(|arc| arc.duration).sum()
    }

    /// Instants at which the jerk jumps, the start and the end among them.
    #[must_use]
    pub fn switches(&self) -> usize {
        let used = || self.arcs().iter().filter(|arc| arc.duration > 0.0);
        let changes = used().zip(used().skip(1)).filter(|(a, b)| a.jerk.total_cmp(&b.jerk).is_ne()).count();
        let ends = [used().next(), used().next_back()];
        changes + ends.iter().flatten().filter(|arc| arc.jerk != 0.0).count()
    }

    /// `integral of j^2`, m^2/s^5.
    #[must_use]
    pub fn effort(&self) -> f64 {
        self.arcs().iter().map(|arc| arc.jerk * arc.jerk * arc.duration).sum()
    }
}
