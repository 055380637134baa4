//! Which shaper for a command that cannot be planned anew.

use profiles::{Complex, Mode, Real};
use shaping::{DelayFilter, Impulse, ImpulseTrain, TrainError};

use super::error::{RecommendError, not_negative, positive};
use super::region::{Region, UncertainMode};

/// Most impulses of a shaper for all modes together.
pub const CAPACITY: usize = 256;

/// A kind of shaper, from short to robust.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum ShaperKind {
    /// Zero vibration: two impulses half a damped period apart.
    Zv,
    /// Zero vibration and zero derivative: three impulses half a damped period apart.
    Zvd,
    /// Zero vibration and two zero derivatives: four impulses half a damped period apart.
    Zvdd,
}

impl ShaperKind {
    /// All kinds, the shortest first.
    pub const ALL: [Self; 3] = [Self::Zv, Self::Zvd, Self::Zvdd];

    /// The name by which it is known.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Zv => "ZV",
            Self::Zvd => "ZVD",
            Self::Zvdd => "ZVDD",
        }
    }

    /// Its impulses for a mode.
    ///
    /// # Errors
    /// A mode whose damped period has no representation.
    pub fn train(&self, mode: Mode) -> Result<ImpulseTrain<CAPACITY>, TrainError> {
        let half = 0.5 * mode.damped_period();
        let decay = Real::exp(mode.pole().re * half);
        let zv = ImpulseTrain::<2>::new(&[Impulse::new(0.0, 1.0), Impulse::new(half, decay)])?;
        match self {
            Self::Zv => ImpulseTrain::new(zv.impulses()),
            Self::Zvd => match DelayFilter::zvd(mode) {
                Ok(filter) => ImpulseTrain::new(filter.train().impulses()),
                Err(_) => zv.convolved(&zv),
            },
            Self::Zvdd => zv.convolved::<2, 3>(&zv)?.convolved(&zv),
        }
    }
}

/// A shaper for one mode, judged over all the mode may be.
#[derive(Debug, Clone, PartialEq)]
pub struct JudgedShaper {
    /// Its kind.
    pub kind: ShaperKind,
    /// Its impulses for this mode.
    pub train: ImpulseTrain<CAPACITY>,
    /// Vibration it leaves of the mode as estimated, as a part of that of a step without it.
    pub nominal: f64,
    /// A bound of that part over all the mode may be.
    pub worst: f64,
}

/// A shaper for every mode.
#[derive(Debug, Clone, PartialEq)]
pub struct ShaperRecommendation {
    /// For every mode in the order given: the shapers that were judged, the shortest first.
    pub judged: Vec<Vec<JudgedShaper>>,
    /// For every mode the place of the chosen one in `judged`.
    pub chosen: Vec<usize>,
    /// The chosen shapers one after the other.
    pub train: ImpulseTrain<CAPACITY>,
    /// A bound of the part that the whole train leaves of any mode.
    pub worst: f64,
    /// Whether that is what is tolerated, or less.
    pub within: bool,
}

/// The shortest shaper that leaves at most the part `tolerated` of the vibration of a step, whatever the modes within so
/// many standard deviations: for every mode the shortest kind that does, or else the one that leaves least.
///
/// The shaped command lasts longer by the duration of the train.
///
/// ```
/// use optimize::{ShaperKind, UncertainMode, recommend_shaper};
/// use profiles::Mode;
///
/// let mode = Mode::from_hz(12.0, 0.05)?;
/// // Known to 0.5 %: ZV leaves 2.4 % at most. Known to 3 %: it may leave 13 %.
/// let sure = recommend_shaper(&[UncertainMode::new(mode, 0.005 * mode.angular_frequency(), 0.0)?], 0.05, 3.0)?;
/// assert_eq!(sure.judged[0][sure.chosen[0]].kind, ShaperKind::Zv);
/// let vague = recommend_shaper(&[UncertainMode::new(mode, 0.03 * mode.angular_frequency(), 0.0)?], 0.05, 3.0)?;
/// assert_ne!(vague.judged[0][vague.chosen[0]].kind, ShaperKind::Zv);
/// assert!(vague.within && vague.worst <= 0.05);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// No modes, a tolerated part that is not positive, deviations that are negative, a mode too vague to reckon with, more
/// impulses than [`CAPACITY`].
pub fn recommend_shaper(
    modes: &[UncertainMode],
    tolerated: f64,
    deviations: f64,
) -> Result<ShaperRecommendation, RecommendError> {
    let tolerated = positive("the tolerated part", tolerated)?;
    let deviations = not_negative("the number of deviations", deviations)?;
    if modes.is_empty() {
        return Err(RecommendError::NoModes);
    }
    let (mut judged, mut chosen, mut trains, mut regions) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for mode in modes {
        let region = Region::of(mode, deviations)?;
        let shapers = shapers(mode, &region, tolerated)?;
        let best = chosen_of(&shapers, tolerated).ok_or(RecommendError::NoModes)?;
        trains.extend(shapers.get(best).map(|shaper| shaper.train));
        (judged.push(shapers), chosen.push(best), regions.push(region));
    }
    let train = all_together(&trains)?;
    let worst = regions.iter().map(|region| worst_of(&train, region, tolerated)).fold(0.0, f64::max);
    Ok(ShaperRecommendation { judged, chosen, train, worst, within: worst <= tolerated })
}

fn shapers(
    mode: &UncertainMode,
    region: &Region,
    tolerated: f64,
) -> Result<Vec<JudgedShaper>, RecommendError> {
    let mut shapers = Vec::new();
    for kind in ShaperKind::ALL {
        let train = kind.train(mode.mode())?;
        let (nominal, worst) = (train.residual(mode.mode()), worst_of(&train, region, tolerated));
        shapers.push(JudgedShaper { kind, train, nominal, worst });
    }
    shapers.sort_by(|a, b| a.train.duration().total_cmp(&b.train.duration()));
    Ok(shapers)
}

/// The first that leaves no more than tolerated, or else the one that leaves least.
fn chosen_of(shapers: &[JudgedShaper], tolerated: f64) -> Option<usize> {
    let within = shapers.iter().position(|shaper| shaper.worst <= tolerated);
    let least = shapers.iter().enumerate().min_by(|(_, a), (_, b)| a.worst.total_cmp(&b.worst));
    within.or(least.map(|(at, _)| at))
}

/// A bound of what a train leaves of a mode, tight to a hundredth of what is tolerated.
pub(super) fn worst_of(train: &ImpulseTrain<CAPACITY>, region: &Region, tolerated: f64) -> f64 {
    let end = train.duration();
    let moment = |power: i32| -> f64 {
        train.impulses().iter().map(|i| i.amplitude.abs() * (end - i.time).powi(power)).sum()
    };
    region.bound(|p: Complex<f64>| train.response(p), [moment(1), moment(2)], 0.01 * tolerated)
}

/// The convolution of trains.
pub(super) fn all_together(trains: &[ImpulseTrain<CAPACITY>]) -> Result<ImpulseTrain<CAPACITY>, TrainError> {
    let unit = ImpulseTrain::<CAPACITY>::new(&[Impulse::new(0.0, 1.0)])?;
    trains.iter().try_fold(unit, |all, train| all.convolved(train))
}
