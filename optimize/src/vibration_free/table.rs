//! A table of moves for a controller.

use std::fmt::Write;

use profiles::switched::{Contact, MoveFamily, MoveTable, MoveTableError, Run};
use profiles::{Interval, Limits, Mode, Profile};
use thiserror::Error;

use super::{Robustness, VibrationFreeError, VibrationFreeMove, plan};

/// What a move of a table may last longer than the planned one, as a part of it, unless another tolerance is asked for.
pub const TABLE_TOLERANCE: f64 = 1e-3;
/// Ratio of neighbouring distances to start with.
const RATIO: f64 = 1.1;
/// Places between two neighbours at which a table is compared with what is planned there, as parts of the difference.
const PLACES: [f64; 3] = [0.5, 0.25, 0.75];
/// Neighbours closer than this, as a part of their distance, are no longer compared.
const CLOSE: f64 = 1e-7;
/// The most moves of a table.
const MOST: usize = 4096;

/// A table of moves that cannot be built or written.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum MoveTableBuildError {
    /// A range of distances that does not grow in one direction, m.
    #[error(
        "a table needs two distances in one direction, the second one longer, got {shortest} and {longest}"
    )]
    Range {
        /// The shortest distance given.
        shortest: f64,
        /// The longest distance given.
        longest: f64,
    },
    /// A tolerance that asks for too much or for nothing.
    #[error("the tolerance of the duration must lie between 1e-9 and 1 of it, got {0}")]
    Tolerance(f64),
    /// Tolerated bands, whose conditions are inequalities that a correction does not know; the half width.
    #[error("a table holds zeros, not tolerated bands, got one of half width {0}")]
    Band(f64),
    /// More moves than a table may have.
    #[error("the table would need more than {most} moves between {shortest} and {longest}")]
    TooMany {
        /// The most there may be.
        most: usize,
        /// The shortest distance.
        shortest: f64,
        /// The longest distance.
        longest: f64,
    },
    /// A move that cannot be planned.
    #[error(transparent)]
    Move(#[from] VibrationFreeError),
    /// A move that does not fit into the table.
    #[error(transparent)]
    Table(#[from] MoveTableError),
    /// A name that is no identifier in capitals.
    #[error("a static needs an identifier in capitals as its name")]
    Name,
    /// The writer reported an error.
    #[error(transparent)]
    Write(#[from] std::fmt::Error),
}

/// A table of moves of at most `N` arcs, with the numbers that it needs.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct OwnedMoveTable<const N: usize> {
    runs: Vec<Run>,
    jerks: Vec<f64>,
    contacts: Vec<Contact>,
    distances: Vec<f64>,
    durations: Vec<f64>,
    limits: Limits,
    modes: Vec<Mode>,
    double: bool,
}

/// A table of the shortest moves over signed distances from `shortest` to `longest`, m, that leave nothing of up to four
/// modes, for a controller that has no time to [`plan`] them: [`MoveTable::rest_to_rest`] interpolates and corrects.
///
/// Moves are planned at distances a tenth apart and then in between, until at the quarters of every gap between moves of the
/// same structure the table's move lasts no longer than the planned one but for a part `tolerance` of it, and in every other
/// gap the longer move itself lasts no longer than the shorter one but for that part ([`TABLE_TOLERANCE`] unless there is a reason).
/// `N` is the number of arcs there is room for: 24 is enough for most moves of one mode.
///
/// ```
/// use optimize::vibration_free::{Robustness, TABLE_TOLERANCE, plan_table};
/// use profiles::{Limits, Mode, Profile, residual_vibration};
///
/// let limits = Limits::new(0.5, 5.0, 200.0)?;
/// let mode = Mode::from_hz(8.0, 0.02)?;
/// let owned = plan_table::<24>(0.1, 0.12, &limits, &[mode], Robustness::None, TABLE_TOLERANCE)?;
/// let table = owned.as_table()?;
/// let motion = table.rest_to_rest(-0.1034)?;
/// assert!(residual_vibration(&motion, mode) < 1e-12 * 0.1034);
/// assert_eq!(motion.sample(motion.duration()).position, -0.1034);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Distances that are not two of one direction, a tolerance outside 1e-9 to 1, [`Robustness::Band`], a move that cannot be
/// planned or has more than `N` arcs, or more than 4096 moves.
pub fn plan_table<const N: usize>(
    shortest: f64,
    longest: f64,
    limits: &Limits,
    modes: &[Mode],
    robustness: Robustness,
    tolerance: f64,
) -> Result<OwnedMoveTable<N>, MoveTableBuildError> {
    let ratio = longest / shortest;
    if !(ratio > 1.0 && ratio.is_finite()) {
        return Err(MoveTableBuildError::Range { shortest, longest });
    }
    if !(1e-9..1.0).contains(&tolerance) {
        return Err(MoveTableBuildError::Tolerance(tolerance));
    }
    if let Robustness::Band { half_width, .. } = robustness {
        return Err(MoveTableBuildError::Band(half_width));
    }
    let gaps = (ratio.ln() / RATIO.ln()).ceil();
    let between = (1..gaps as usize).map(|k| shortest * ratio.powf(k as f64 / gaps));
    let distances = between.chain([longest]);
    let asked = Asked { limits, modes, robustness, tolerance };
    let mut moves = vec![Planned::new(plan(shortest, limits, modes, robustness)?)];
    for distance in distances {
        let Some(last) = moves.last() else { continue };
        // Both ways, as a search may end in an optimum of its neighbourhood.
        let near = asked.near(&last.motion, distance);
        match (plan(distance, limits, modes, robustness), near) {
            (Ok(motion), near) => moves.push(Planned::new(motion).or_shorter(near.ok())),
            (Err(_), Ok(near)) => moves.push(Planned::new(near)),
            (Err(error), _) if distance.total_cmp(&longest).is_eq() => return Err(error.into()),
            // A longer step over a distance that the search does not master.
            _ => {}
        }
    }
    let double = robustness == Robustness::DoubleZero;
    let family = |moves: &[Planned]| OwnedMoveTable::<N>::of(moves, limits, modes, double);
    // Where a gap is cut its neighbours extrapolate along other lines.
    loop {
        let owned = family(&moves);
        let table = owned.as_table()?;
        let mut more = Vec::new();
        for (k, pair) in moves.windows(2).enumerate() {
            let [below, above] = pair else { continue };
            if below.checked {
                continue;
            }
            if let Some(planned) = asked.longer(&table, below, above)? {
                more.push((k + 1, planned));
            }
        }
        if more.is_empty() {
            return Ok(owned);
        }
        if moves.len() + more.len() > MOST {
            return Err(MoveTableBuildError::TooMany { most: MOST, shortest, longest });
        }
        moves.iter_mut().for_each(|planned| planned.checked = true);
        for (k, planned) in more.into_iter().rev() {
            moves.insert(k, planned);
            let near = k.saturating_sub(2)..=k + 1;
            moves
                .iter_mut()
                .enumerate()
                .filter(|(i, _)| near.contains(i))
                .for_each(|(_, m)| m.checked = false);
        }
    }
}

/// A move of the family.
struct Planned {
    motion: VibrationFreeMove,
    distance: f64,
    /// Whether the gap after it has been compared with what is planned in it.
    checked: bool,
}

impl Planned {
    fn new(motion: VibrationFreeMove) -> Self {
        let distance = motion.goal().distance.unwrap_or(0.0);
        Self { motion, distance, checked: false }
    }

    fn or_shorter(self, other: Option<VibrationFreeMove>) -> Self {
        match other {
            Some(motion) if motion.duration() < self.motion.duration() => Self { motion, ..self },
            _ => self,
        }
    }
}

/// What is asked of all moves.
struct Asked<'a> {
    limits: &'a Limits,
    modes: &'a [Mode],
    robustness: Robustness,
    tolerance: f64,
}

impl Asked<'_> {
    /// The move over a distance near that of another one.
    fn near(
        &self,
        known: &VibrationFreeMove,
        distance: f64,
    ) -> Result<VibrationFreeMove, VibrationFreeError> {
        // Without modes it is a closed form.
        if self.modes.is_empty() {
            plan(distance, self.limits, self.modes, self.robustness)
        } else {
            known.replanned(distance)
        }
    }

    /// A move within a gap than which the table's lasts too long.
    fn longer<const N: usize>(
        &self,
        table: &MoveTable<'_, N>,
        below: &Planned,
        above: &Planned,
    ) -> Result<Option<Planned>, MoveTableBuildError> {
        let gap = above.distance - below.distance;
        let bound = below.motion.duration() * (1.0 + self.tolerance);
        // No move lasts longer than the next one of the table.
        if above.motion.duration() <= bound || gap.abs() <= CLOSE * above.distance.abs() {
            return Ok(None);
        }
        for part in PLACES {
            let distance = below.distance + part * gap;
            // A distance that the search does not master has the table's move.
            let Ok(motion) = self.near(&below.motion, distance) else { continue };
            let planned = Planned::new(motion).or_shorter(self.near(&above.motion, distance).ok());
            // Where the structure changes, others may come and go between any two places.
            let long = || -> Result<bool, MoveTableError> {
                Ok(table.rest_to_rest(distance)?.duration()
                    > planned.motion.duration() * (1.0 + self.tolerance))
            };
            if !same_structure(&below.motion, &above.motion) || long()? {
                return Ok(Some(planned));
            }
        }
        Ok(None)
    }
}

/// Whether two moves have the same jerks one after the other, and meet the same limits where.
fn same_structure(a: &VibrationFreeMove, b: &VibrationFreeMove) -> bool {
    let alike = a.arcs().iter().zip(b.arcs()).all(|(a, b)| a.jerk.total_cmp(&b.jerk).is_eq());
    a.arcs().len() == b.arcs().len() && alike && a.contacts() == b.contacts()
}

impl<const N: usize> OwnedMoveTable<N> {
    fn of(moves: &[Planned], limits: &Limits, modes: &[Mode], double: bool) -> Self {
        let mut table = Self {
            runs: vec![],
            jerks: vec![],
            contacts: vec![],
            distances: vec![],
            durations: vec![],
            limits: *limits,
            modes: modes.to_vec(),
            double,
        };
        let mut last: Option<&VibrationFreeMove> = None;
        for Planned { motion, distance, .. } in moves {
            match table.runs.last_mut() {
                Some(run) if last.is_some_and(|last| same_structure(last, motion)) => run.moves += 1,
                _ => {
                    table.runs.push(Run {
                        arcs: motion.arcs().len(),
                        contacts: motion.contacts().len(),
                        moves: 1,
                    });
                    table.jerks.extend(motion.arcs().iter().map(|arc| arc.jerk));
                    table.contacts.extend(motion.contacts());
                }
            }
            table.distances.push(*distance);
            table.durations.extend(motion.arcs().iter().map(|arc| arc.duration));
            last = Some(motion);
        }
        table
    }

    /// The numbers of the table.
    #[must_use]
    pub fn as_family(&self) -> MoveFamily<'_> {
        MoveFamily {
            runs: &self.runs,
            jerks: &self.jerks,
            contacts: &self.contacts,
            distances: &self.distances,
            durations: &self.durations,
        }
    }

    /// The table, checked as one from anywhere is.
    ///
    /// # Errors
    /// None for a table as it was built; for one that was read those of [`MoveTable::new`].
    pub fn as_table(&self) -> Result<MoveTable<'_, N>, MoveTableError> {
        MoveTable::new(self.as_family(), &self.limits, &self.modes, self.double)
    }

    /// Writes the numbers as a module of Rust with a `static` of the type [`MoveFamily`], every one with the fewest digits
    /// that read back as the same.
    ///
    /// # Errors
    /// A name that is no identifier in capitals, or whatever the writer reports.
    pub fn write_rust<W: Write + ?Sized>(&self, name: &str, out: &mut W) -> Result<(), MoveTableBuildError> {
        let mut letters = name.bytes();
        let starts = letters.next().is_some_and(|c| c.is_ascii_uppercase());
        if !(starts && letters.all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == b'_')) {
            return Err(MoveTableBuildError::Name);
        }
        let contact = if self.contacts.is_empty() { "" } else { "Contact, " };
        writeln!(out, "use profiles::switched::{{{contact}MoveFamily, Run}};\n")?;
        let (first, last) = (self.distances.first(), self.distances.last());
        let range = Interval::new(first.copied().unwrap_or(0.0), last.copied().unwrap_or(0.0));
        let (moves, most) = (self.distances.len(), self.runs.iter().map(|run| run.arcs).max().unwrap_or(0));
        writeln!(
            out,
            "/// {moves} moves of at most {most} arcs over {} to {} m, within",
            range.lower, range.upper
        )?;
        writeln!(out, "/// {:?},", self.limits)?;
        writeln!(
            out,
            "/// with {} zeros at {:?}.",
            if self.double { "double" } else { "single" },
            self.modes
        )?;
        writeln!(
            out,
            "#[rustfmt::skip]\npub static {name}: MoveFamily<'static> = MoveFamily {{\n    runs: &["
        )?;
        self.runs.iter().try_for_each(|run| writeln!(out, "        {run:?},"))?;
        writeln!(out, "    ],\n    jerks: &{:?},\n    contacts: &[", self.jerks)?;
        self.contacts.iter().try_for_each(|contact| writeln!(out, "        Contact::{contact:?},"))?;
        writeln!(out, "    ],\n    distances: &{:?},\n    durations: &[", self.distances)?;
        let mut durations = self.durations.as_slice();
        for run in &self.runs {
            for _ in 0..run.moves {
                let (these, rest) = durations.split_at(run.arcs.min(durations.len()));
                durations = rest;
                write!(out, "       ")?;
                these.iter().try_for_each(|duration| write!(out, " {duration:?},"))?;
                writeln!(out)?;
            }
        }
        writeln!(out, "    ],\n}};")?;
        Ok(())
    }
}
