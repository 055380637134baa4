//! The list of every experiment, in the order of the report.

use crate::experiment::Experiment;

/// Every paper and study, in the order they are listed, run and shown.
pub const EXPERIMENTS: &[Experiment] = &[
    crate::papers::acceleration_curves::EXPERIMENT,
    crate::papers::delay_filter::EXPERIMENT,
    crate::papers::belt_pso::EXPERIMENT,
    crate::papers::cross_coupling::EXPERIMENT,
    crate::papers::nurbs_reduction::EXPERIMENT,
    crate::studies::zero_vibration::EXPERIMENT,
];

/// The experiments that `ids` name, in the order of `experiments`; all of them when `ids` is empty.
///
/// An id is a whole id or the beginning of one or more; a whole id selects nothing else.
///
/// # Errors
/// One line naming the first id that selects nothing.
pub fn select<'a>(experiments: &'a [Experiment], ids: &[String]) -> Result<Vec<&'a Experiment>, String> {
    let mut wanted = vec![ids.is_empty(); experiments.len()];
    for id in ids {
        let exact = experiments.iter().any(|e| e.id == id);
        let mut found = false;
        for (experiment, wanted) in experiments.iter().zip(&mut wanted) {
            let hit = if exact { experiment.id == id } else { experiment.id.starts_with(id.as_str()) };
            if hit && !id.is_empty() {
                *wanted = true;
                found = true;
            }
        }
        if !found {
            let known: Vec<&str> = experiments.iter().map(|e| e.id).collect();
            let known = if known.is_empty() { "none yet".to_owned() } else { known.join(", ") };
            return Err(format!("no experiment '{id}'; there are: {known}"));
        }
    }
    Ok(experiments.iter().zip(wanted).filter_map(|(e, wanted)| wanted.then_some(e)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiment::Outcome;

    fn named(id: &'static str) -> Experiment {
        Experiment {
            id,
            title: "",
            citation: "",
            sources: &[],
            expected: "",
            readme_figure: None,
            run: |_| Ok(Outcome::default()),
        }
    }

    fn ids(wanted: &[&str]) -> Result<Vec<&'static str>, String> {
        let all = [named("belt"), named("belt-pso"), named("delay-filter")];
        let wanted: Vec<String> = wanted.iter().map(|s| (*s).to_owned()).collect();
        select(&all, &wanted).map(|found| found.iter().map(|e| e.id).collect())
    }

    #[test]
    fn an_id_is_whole_or_a_beginning() {
        assert_eq!(ids(&[]).unwrap(), ["belt", "belt-pso", "delay-filter"]);
        assert_eq!(ids(&["belt"]).unwrap(), ["belt"]);
        assert_eq!(ids(&["bel"]).unwrap(), ["belt", "belt-pso"]);
        assert_eq!(ids(&["delay", "belt", "belt"]).unwrap(), ["belt", "delay-filter"]);
    }

    #[test]
    fn an_unknown_or_empty_id_is_one_line() {
        assert_eq!(
            ids(&["belt", "nurbs"]).unwrap_err(),
            "no experiment 'nurbs'; there are: belt, belt-pso, delay-filter"
        );
        assert!(ids(&[""]).is_err());
        assert_eq!(select(&[], &["x".to_owned()]).unwrap_err(), "no experiment 'x'; there are: none yet");
    }

    #[test]
    fn the_registry_is_sound() {
        for (n, experiment) in EXPERIMENTS.iter().enumerate() {
            assert!(
                EXPERIMENTS.iter().skip(n + 1).all(|other| other.id != experiment.id),
                "{} twice",
                experiment.id
            );
            assert!(crate::figure::is_file_name(experiment.id), "{}", experiment.id);
            crate::expected::parse(experiment.expected).unwrap();
        }
    }
}
