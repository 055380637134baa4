//! One estimate of a mode from several views of a log.

use profiles::Mode;

/// A mode as one view of the log shows it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sighting {
    /// Undamped angular frequency, rad/s.
    pub(super) frequency: f64,
    /// Damping ratio.
    pub(super) damping: f64,
    /// Standard deviation of the angular frequency, rad/s.
    pub(super) frequency_deviation: f64,
    /// Standard deviation of the damping ratio.
    pub(super) damping_deviation: f64,
    /// Largest amplitude in the log, in the unit of the response.
    pub(super) amplitude: f64,
    /// Amplitude over that of a unit mode under the same command; none where the command hardly drives it.
    pub(super) participation: Option<f64>,
    /// How surely it is there: its norm over that of the noise.
    pub(super) significance: f64,
}

impl Sighting {
    pub(super) fn is_usable(&self) -> bool {
        let vague = self.frequency_deviation / self.frequency;
        vague < 0.3 && self.damping_deviation < 0.5 && self.frequency > 0.0
    }
}

/// What several sightings of one mode say together.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pooled {
    pub(super) mode: Sighting,
    /// Views in which it was seen.
    pub(super) found: usize,
}

impl Pooled {
    pub(super) fn mode(&self) -> Option<Mode> {
        Mode::new(self.mode.frequency, self.mode.damping.max(0.0)).ok()
    }
}

/// Groups the sightings of all views by frequency and pools every group; the most significant group first.
pub(super) fn pooled(views: &[Vec<Sighting>]) -> Vec<Pooled> {
    let mut left: Vec<Vec<Sighting>> =
        views.iter().map(|view| view.iter().copied().filter(Sighting::is_usable).collect()).collect();
    let mut groups = Vec::new();
    let mut most = usize::MAX;
    while let Some(lead) =
        left.iter().flatten().copied().max_by(|a, b| a.significance.total_cmp(&b.significance))
    {
        let group: Vec<Sighting> = left.iter_mut().filter_map(|view| taken(view, &lead)).collect();
        groups.extend(together(&group));
        // The lead itself is always taken, so that this ends.
        let rest = left.iter().map(Vec::len).sum();
        if rest >= most {
            break;
        }
        most = rest;
    }
    groups
}

/// The sighting of a view that is nearest to `lead`, if it can be the same mode, taken out of the view.
fn taken(view: &mut Vec<Sighting>, lead: &Sighting) -> Option<Sighting> {
    const SAME: f64 = 0.05;
    let distance = |s: &Sighting| (s.frequency - lead.frequency).abs();
    let (at, nearest) =
        view.iter().enumerate().min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)))?;
    let spread = nearest.frequency_deviation.hypot(lead.frequency_deviation);
    let same = distance(nearest) <= (3.0 * spread).max(SAME * lead.frequency);
    same.then(|| view.swap_remove(at))
}

fn together(group: &[Sighting]) -> Option<Pooled> {
    group.first()?;
    let pick = |value: fn(&Sighting) -> f64, deviation: fn(&Sighting) -> f64| {
        random_effects(&group.iter().map(|s| (value(s), deviation(s))).collect::<Vec<_>>())
    };
    let (frequency, frequency_deviation) = pick(|s| s.frequency, |s| s.frequency_deviation);
    let (damping, damping_deviation) = pick(|s| s.damping, |s| s.damping_deviation);
    let largest = |part: fn(&Sighting) -> f64| group.iter().map(part).fold(0.0, f64::max);
    let mut participations: Vec<f64> = group.iter().filter_map(|s| s.participation).collect();
    participations.sort_by(f64::total_cmp);
    let mode = Sighting {
        frequency,
        damping,
        frequency_deviation,
        damping_deviation,
        amplitude: largest(|s| s.amplitude),
        participation: participations.get(participations.len() / 2).copied(),
        significance: largest(|s| s.significance),
    };
    Some(Pooled { mode, found: group.len() })
}

/// Mean and standard deviation of the next draw from a population of which every view shows one with its own error.
///
/// Views that differ by more than their deviations differ in truth: friction, backlash and a load that moves make a
/// mode vary. With the weights `w = 1/s^2`, `Q = sum w (x - mean)^2` about the mean with these weights, and
/// `C = sum w - sum w^2 / sum w`, the variance between views is `t^2 = max(0, (Q - (n - 1)) / C)`. The mean then has the
/// weights `1/(s^2 + t^2)`. Its variance is that of the best view plus `t^2`: views overlap, so their number does not
/// make it smaller.
///
/// # References
/// R. DerSimonian, N. Laird, "Meta-analysis in clinical trials", Controlled Clinical Trials 7 (1986),
/// doi:10.1016/0197-2456(86)90046-2.
fn random_effects(views: &[(f64, f64)]) -> (f64, f64) {
    // An exact view has no weight that could be computed with; its rounding has.
    let largest = views.iter().fold(0.0_f64, |largest, (x, _)| largest.max(x.abs()));
    let square = |s: f64| (s * s).max((1e-12 * largest) * (1e-12 * largest)).max(1e-100);
    let mean = |between: f64| {
        let sum: f64 = views.iter().map(|(_, s)| 1.0 / (square(*s) + between)).sum();
        views.iter().map(|(x, s)| x / (square(*s) + between)).sum::<f64>() / sum
    };
    let weights = |power: i32| views.iter().map(|(_, s)| square(*s).recip().powi(power)).sum::<f64>();
    let centre = mean(0.0);
    let q: f64 = views.iter().map(|(x, s)| (x - centre) * (x - centre) / square(*s)).sum();
    let c = weights(1) - weights(2) / weights(1);
    let between =
        if views.len() > 1 && c > 0.0 { ((q - (views.len() - 1) as f64) / c).max(0.0) } else { 0.0 };
    let best = views.iter().map(|(_, s)| square(*s)).fold(f64::INFINITY, f64::min);
    (mean(between), (best + between).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(frequency: f64, deviation: f64) -> Sighting {
        Sighting {
            frequency,
            damping: 0.05,
            frequency_deviation: deviation,
            damping_deviation: 0.001,
            amplitude: 1.0,
            participation: None,
            significance: 1.0 / deviation,
        }
    }

    #[test]
    fn views_that_agree_keep_the_deviation_of_the_best() {
        let (mean, deviation) = random_effects(&[(10.0, 0.1), (10.1, 0.2), (9.9, 0.2)]);
        assert!((mean - 10.0).abs() < 1e-12 && (deviation - 0.1).abs() < 1e-12);
    }

    #[test]
    fn views_that_differ_show_their_spread() {
        // Exact views: the variance between them is their sample variance, here 1.
        let (mean, deviation) = random_effects(&[(9.0, 1e-6), (10.0, 1e-6), (11.0, 1e-6)]);
        assert!((mean - 10.0).abs() < 1e-9 && (deviation - 1.0).abs() < 1e-9);
        let (mean, deviation) = random_effects(&[(9.0, 0.0), (11.0, 0.0)]);
        assert!((mean - 10.0).abs() < 1e-9 && (deviation - 2.0_f64.sqrt()).abs() < 1e-9);
    }

    #[test]
    fn modes_are_told_apart_by_frequency() {
        let views =
            [vec![seen(100.0, 0.1), seen(200.0, 1.0)], vec![seen(101.0, 0.1)], vec![seen(205.0, 2.0)]];
        let groups = pooled(&views);
        assert_eq!(groups.iter().map(|g| g.found).collect::<Vec<_>>(), [2, 2]);
        assert!((groups[0].mode.frequency - 100.5).abs() < 1e-9);
        assert!(groups[0].mode.frequency_deviation > 0.6 && groups[1].mode.frequency_deviation > 1.0);
        // Nothing usable, nothing pooled.
        assert!(pooled(&[vec![seen(100.0, 50.0)]]).is_empty() && pooled(&[]).is_empty());
    }
}
