//! Which shaper for a command that cannot be planned anew.

use shaping::{Impulse, ImpulseTrain, Shaper, TrainError};

use super::error::{RecommendError, not_negative, positive};
use super::region::{Region, UncertainMode};

/// Most impulses of a shaper for all modes together.
pub const CAPACITY: usize = 256;

/// The name by which a shaper is known: `ZVD`, `EI`, `2-hump EI`.
#[must_use]
pub fn shaper_name(shaper: &Shaper) -> String {
    match *shaper {
        Shaper::ZeroVibration { order } => format!("ZV{}", "D".repeat(order.saturating_sub(1))),
        Shaper::EquallySpaced { impulses: 3, .. } => "MZV".to_owned(),
        Shaper::EquallySpaced { impulses, .. } => format!("MZV with {impulses} impulses"),
        Shaper::ExtraInsensitive { humps: 1, .. } => "EI".to_owned(),
        Shaper::ExtraInsensitive { humps, .. } => format!("{humps}-hump EI"),
        Shaper::Negative { order: 1, .. } => "negative ZV".to_owned(),
        Shaper::Negative { .. } => "negative ZVD".to_owned(),
        _ => format!("{shaper:?}"),
    }
}

/// The positive shapers a recommendation chooses from, with the part of the vibration that the insensitive ones may
/// leave.
pub(super) fn kinds(tolerated: f64) -> [Shaper; 7] {
    // Of a hump higher than this little is left to shape.
    let tolerance = tolerated.clamp(1e-3, 0.3);
    let humps = |humps| Shaper::ExtraInsensitive { humps, tolerance };
    [Shaper::MZV, Shaper::ZV, Shaper::ZVD, humps(1), Shaper::ZVDD, humps(2), humps(3)]
}

/// A shaper for one mode, judged over all the mode may be.
#[derive(Debug, Clone, PartialEq)]
pub struct JudgedShaper {
    /// The shaper.
    pub shaper: Shaper,
    /// Its impulses for this mode.
    pub train: ImpulseTrain<CAPACITY>,
    /// Vibration it leaves of the mode as estimated, as a part of that of a step without it.
    pub nominal: f64,
    /// A bound of that part over all the mode may be.
    pub worst: f64,
}

impl JudgedShaper {
    /// The name by which it is known.
    #[must_use]
    pub fn name(&self) -> String {
        shaper_name(&self.shaper)
    }
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
/// The shaped command lasts longer by the duration of the train. Only trains of positive impulses are considered: the
/// limits of the command that comes in hold for the one that goes out.
///
/// ```
/// use optimize::{UncertainMode, recommend_shaper};
/// use profiles::Mode;
///
/// let mode = Mode::from_hz(12.0, 0.05)?;
/// let name = |deviation: f64| -> Result<String, Box<dyn std::error::Error>> {
///     let mode = UncertainMode::new(mode, deviation * mode.angular_frequency(), 0.0)?;
///     let found = recommend_shaper(&[mode], 0.05, 3.0)?;
///     assert!(found.within && found.worst <= 0.05);
///     Ok(found.judged[0][found.chosen[0]].name())
/// };
/// // With the frequency known to 0.5, 1.5 and 6 % (one standard deviation)
/// assert_eq!([name(0.005)?, name(0.015)?, name(0.06)?], ["ZV", "MZV", "EI"]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// No modes, a tolerated part that is not positive, deviations that are negative, a mode too vague to reckon with, more
/// impulses than 256.
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
        let shapers = shapers(mode, &region, tolerated);
        let best = chosen_of(&shapers, tolerated)
            .ok_or(RecommendError::NoShaper { angular_frequency: mode.mode().angular_frequency() })?;
        trains.extend(shapers.get(best).map(|shaper| shaper.train));
        judged.push(shapers);
        chosen.push(best);
        regions.push(region);
    }
    let train = all_together(&trains)?;
    let worst = regions.iter().map(|region| train.worst_case(region.modes()).bound).fold(0.0, f64::max);
    Ok(ShaperRecommendation { judged, chosen, train, worst, within: worst <= tolerated })
}

/// The kinds that exist for a mode, the shortest first.
fn shapers(mode: &UncertainMode, region: &Region, tolerated: f64) -> Vec<JudgedShaper> {
    let judged = |shaper: Shaper| {
        let train: ImpulseTrain<CAPACITY> = shaper.train(mode.mode()).ok()?;
        let (nominal, worst) = (train.residual(mode.mode()), train.worst_case(region.modes()).bound);
        Some(JudgedShaper { shaper, train, nominal, worst })
    };
    // A bound lies above what is attained by a millionth, a hump as high as tolerated not.
    let mut shapers: Vec<JudgedShaper> =
        kinds(0.999 * tolerated - 1e-6).into_iter().filter_map(judged).collect();
    shapers.sort_by(|a, b| a.train.duration().total_cmp(&b.train.duration()));
    shapers
}

/// The first that leaves no more than tolerated, or else the one that leaves least.
fn chosen_of(shapers: &[JudgedShaper], tolerated: f64) -> Option<usize> {
    let within = shapers.iter().position(|shaper| shaper.worst <= tolerated);
    let least = shapers.iter().enumerate().min_by(|(_, a), (_, b)| a.worst.total_cmp(&b.worst));
    within.or(least.map(|(at, _)| at))
}

/// The convolution of trains.
pub(super) fn all_together(trains: &[ImpulseTrain<CAPACITY>]) -> Result<ImpulseTrain<CAPACITY>, TrainError> {
    let unit = ImpulseTrain::<CAPACITY>::new(&[Impulse::new(0.0, 1.0)])?;
    trains.iter().try_fold(unit, |all, train| all.convolved(train))
}
