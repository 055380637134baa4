//! The head of a log: what separates its columns, and which of them are wanted.

use super::error::LogFileError;

/// Names or numbers of the three columns.
#[derive(Clone, Debug)]
pub struct Columns {
    /// The time.
    pub time: String,
    /// The command.
    pub command: String,
    /// The response.
    pub response: String,
}

/// Where the wanted columns are, and what is known of them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Layout {
    pub(super) separator: u8,
    /// Columns of a line.
    pub(super) width: usize,
    /// Places of time, command and response.
    pub(super) at: [usize; 3],
    /// Their names.
    pub(super) names: [String; 3],
    /// Seconds to a unit of the time, where the header says.
    pub(super) time_unit: Option<f64>,
}

/// What separates the columns of a line of data: a tab, a semicolon or a comma, in this order.
pub(super) fn separator(line: &str) -> Option<u8> {
    [b'\t', b';', b','].into_iter().find(|separator| line.bytes().any(|byte| byte == *separator))
}

/// The cells of a line, without blanks and quotes around them.
pub(super) fn cells(line: &str, separator: u8) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .flexible(true)
        .from_reader(line.as_bytes());
    let record = reader.byte_records().next();
    let cell = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim().trim_matches('"').trim().to_owned();
    record.and_then(Result::ok).map_or_else(Vec::new, |record| record.iter().map(cell).collect())
}

/// A number as logs write it; where commas do not separate columns they may mark decimals.
pub(super) fn number(text: &str, separator: u8) -> Option<f64> {
    let text = text.trim().trim_matches('"').trim();
    text.parse().ok().or_else(|| {
        let decimal = separator != b',' && text.matches(',').count() == 1 && !text.contains('.');
        if decimal { text.replace(',', ".").parse().ok() } else { None }
    })
}

impl Layout {
    /// The layout of a log with the given header, if it has one, and the given first line of data.
    pub(super) fn of(
        header: Option<&[String]>,
        data: &[String],
        separator: u8,
        wanted: &Columns,
    ) -> Result<Self, LogFileError> {
        let numbered: Vec<String> = (1..=data.len()).map(|n| n.to_string()).collect();
        let names = header.unwrap_or(&numbered);
        let find = |role: &'static str, wanted: &str| -> Result<usize, LogFileError> {
            let problem = |problem| LogFileError::Column {
                problem,
                wanted: wanted.to_owned(),
                role,
                there: names.to_vec(),
            };
            let by = |same: &dyn Fn(&str) -> bool| -> Vec<usize> {
                names.iter().enumerate().filter(|(_, name)| same(name)).map(|(at, _)| at).collect()
            };
            let exact = by(&|name| name == wanted);
            let loose = by(&|name| bare(name).eq_ignore_ascii_case(bare(wanted)));
            match (exact.as_slice(), loose.as_slice()) {
                ([at], _) | ([], [at]) => Ok(*at),
                ([], []) => wanted
                    .parse::<usize>()
                    .ok()
                    .and_then(|n| n.checked_sub(1))
                    .filter(|at| *at < names.len())
                    .ok_or_else(|| problem("no column")),
                _ => Err(problem("more than one column")),
            }
        };
        let at = [
            find("time", &wanted.time)?,
            find("command", &wanted.command)?,
            find("response", &wanted.response)?,
        ];
        let name = |at: usize| names.get(at).cloned().unwrap_or_default();
        let time_unit = unit(&name(at[0])).and_then(seconds);
        Ok(Self { separator, width: names.len(), at, names: at.map(name), time_unit })
    }
}

/// A name without the unit behind it: `time [s]` and `time (s)` are `time`.
pub(super) fn bare(name: &str) -> &str {
    name.split(['[', '(']).next().unwrap_or(name).trim()
}

/// The unit behind a name.
pub(super) fn unit(name: &str) -> Option<&str> {
    let (_, behind) = name.split_once(['[', '('])?;
    Some(behind.trim_end_matches([']', ')']).trim())
}

/// The unit of the `order`th rate of a quantity with this unit: `m/s^2`; nothing of one without.
pub(super) fn rate(unit: &str, order: u32) -> String {
    let unit = if unit.contains('/') { format!("({unit})") } else { unit.to_owned() };
    match order {
        _ if unit.is_empty() => unit,
        0 => unit,
        1 => format!("{unit}/s"),
        _ => format!("{unit}/s^{order}"),
    }
}

/// Seconds to a unit of time.
fn seconds(unit: &str) -> Option<f64> {
    match unit {
        "s" | "sec" => Some(1.0),
        "ms" => Some(1e-3),
        "us" | "µs" => Some(1e-6),
        "ns" => Some(1e-9),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wanted(time: &str, command: &str, response: &str) -> Columns {
        let [time, command, response] = [time, command, response].map(str::to_owned);
        Columns { time, command, response }
    }

    fn row(line: &str) -> Vec<String> {
        cells(line, separator(line).unwrap_or(b','))
    }

    #[test]
    fn separators_are_told_by_rank() {
        assert_eq!(separator("0,1\t2,5"), Some(b'\t'));
        assert_eq!(separator("0,1;2,5"), Some(b';'));
        assert_eq!(separator("0.1,2.5"), Some(b','));
        assert_eq!(separator("0.1 2.5"), None);
        assert_eq!(row("\"a, b\", c "), ["a, b", "c"]);
    }

    #[test]
    fn numbers_may_have_a_decimal_comma() {
        assert_eq!(number(" \"0,25\" ", b';'), Some(0.25));
        assert_eq!(number("0,25", b','), None);
        assert_eq!(number("1,000.5", b';'), None);
        assert_eq!(number("-1.5e-3", b','), Some(-1.5e-3));
    }

    #[test]
    fn units_stand_behind_names() {
        assert_eq!(["angle (deg)", "x [ m ]", "u"].map(unit), [Some("deg"), Some("m"), None]);
        assert_eq!([0, 1, 2].map(|order| rate("m", order)), ["m", "m/s", "m/s^2"]);
        assert_eq!((rate("", 2).as_str(), rate("mm/s", 1).as_str()), ("", "(mm/s)/s"));
    }

    #[test]
    fn columns_are_found_by_name_without_unit_or_by_number() {
        let (header, data) = (row("Time [ms],u,y,y [rad]"), row("0,1,2,3"));
        let layout = |time, command, response| {
            Layout::of(Some(&header), &data, b',', &wanted(time, command, response))
        };
        let found = layout("time", "u", "4").expect("there");
        assert_eq!((found.at, found.time_unit), ([0, 1, 3], Some(1e-3)));
        assert_eq!(found.names, ["Time [ms]", "u", "y [rad]"]);
        // The exact name comes before the one without its unit.
        assert_eq!(layout("time", "u", "y").expect("there").at, [0, 1, 2]);
        let missing = layout("time", "u", "velocity").expect_err("not there").to_string();
        assert!(
            missing.starts_with("no column 'velocity' for the response: there are 'Time [ms]', 'u'"),
            "{missing}"
        );
        let both = Layout::of(Some(&row("t,u [V],u [A]")), &data, b',', &wanted("t", "u", "1"));
        assert!(both.expect_err("two").to_string().starts_with("more than one column 'u'"));
        assert_eq!(Layout::of(None, &data, b',', &wanted("1", "2", "4")).expect("there").at, [0, 1, 3]);
        assert!(Layout::of(None, &data, b',', &wanted("time", "2", "4")).is_err());
        assert!(Layout::of(None, &data, b',', &wanted("0", "2", "5")).is_err());
    }
}
