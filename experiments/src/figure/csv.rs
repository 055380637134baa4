//! The table behind a figure.

use anyhow::{Result, anyhow};

use super::{Figure, Quantity};

/// A column of x and the columns of y sampled there.
struct Group<'a> {
    x: Vec<f64>,
    columns: Vec<(String, &'a [(f64, f64)])>,
}

/// The table of a figure: a header with names and units, and every sample of every series in shortest exact digits.
///
/// Series sampled at the same points share one x column, which stands before them. The first x column bears the name
/// of the axis (`time [s]`); where others follow, each names the series it belongs to (`time of velocity s-curve [s]`).
/// A column shorter than the table ends in empty cells.
///
/// # Errors
/// What the table cannot be written for: nothing that [`Figure::check`] accepts.
pub fn to_csv(figure: &Figure) -> Result<String> {
    let mut groups: Vec<Group<'_>> = Vec::new();
    for panel in &figure.panels {
        for (name, points) in panel.columns() {
            let column = (format!("{} {name}", panel.y.name).trim_end().to_owned(), points);
            let title = (titled(&column.0, &panel.y), column.1);
            // Bit for bit: a shared column must not lose a sample.
            let same = |group: &&mut Group<'_>| {
                group.x.len() == points.len()
                    && group.x.iter().zip(points).all(|(a, (b, _))| a.to_bits() == b.to_bits())
            };
            match groups.iter_mut().find(same) {
                Some(group) => group.columns.push(title),
                None => {
                    groups.push(Group { x: points.iter().map(|(x, _)| *x).collect(), columns: vec![title] })
                }
            }
        }
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    let mut header = Vec::new();
    for (n, group) in groups.iter().enumerate() {
        let of =
            group.columns.first().filter(|_| n > 0).map(|(name, _)| name.split(" [").next().unwrap_or(name));
        let name = of.map_or(figure.x.name.clone(), |of| format!("{} of {of}", figure.x.name));
        header.push(titled(&name, &figure.x));
        header.extend(group.columns.iter().map(|(name, _)| name.clone()));
    }
    writer.write_record(&header)?;
    for row in 0..groups.iter().map(|group| group.x.len()).max().unwrap_or(0) {
        let mut record = Vec::with_capacity(header.len());
        for group in &groups {
            record.push(cell(group.x.get(row).copied()));
            record.extend(group.columns.iter().map(|(_, points)| cell(points.get(row).map(|(_, y)| *y))));
        }
        writer.write_record(&record)?;
    }
    let bytes = writer.into_inner().map_err(|error| anyhow!("the table of '{}': {error}", figure.id))?;
    Ok(String::from_utf8(bytes)?)
}

fn titled(name: &str, quantity: &Quantity) -> String {
    if quantity.unit.is_empty() { name.to_owned() } else { format!("{name} [{}]", quantity.unit) }
}

fn cell(value: Option<f64>) -> String {
    value.map_or(String::new(), |x| format!("{x:?}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::{Panel, Role};

    #[test]
    fn series_on_the_same_points_share_a_column() {
        let line = |k: f64| vec![(0.0, 0.0), (0.1, 0.1 * k)];
        let figure = Figure::new("fig7", "", Quantity::time())
            .panel(
                Panel::new(Quantity::new("velocity", "v", "m/s"))
                    .line("s-curve", Role::Ours, line(1.0))
                    .line("cosine, ramp", Role::Second, vec![(0.05, 0.5)])
                    .marks("published", vec![(0.05, 0.2)]),
            )
            .panel(Panel::new(Quantity::new("duty", "d", "")).line("", Role::Ours, line(3.0)));
        assert_eq!(
            to_csv(&figure).unwrap(),
            "time [s],velocity s-curve [m/s],duty,\"time of velocity cosine, ramp [s]\",\"velocity cosine, ramp [m/s]\",\
             velocity published [m/s]\n\
             0.0,0.0,0.0,0.05,0.5,0.2\n\
             0.1,0.1,0.30000000000000004,,,\n"
        );
    }
}
