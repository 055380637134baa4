//! Recorded channels.

use std::io::{self, Write};

use crate::error::RecordingError;

/// The name and the unit of a recorded signal.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Channel {
    /// Name, by which the signal is found.
    pub name: String,
    /// Unit, as printed.
    pub unit: String,
}

impl Channel {
    /// A channel from its name and unit.
    #[must_use]
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into() }
    }
}

impl From<(&str, &str)> for Channel {
    fn from((name, unit): (&str, &str)) -> Self {
        Self::new(name, unit)
    }
}

/// Signals over time, one column of numbers for each channel.
///
/// ```
/// use plants::Recording;
///
/// let mut recording = Recording::new([("position", "m"), ("force", "N")], 2)?;
/// recording.push(0.0, [0.0, 1.0])?;
/// recording.push(0.1, [0.005, -3.0])?;
/// assert_eq!(recording.column("position")?, [0.0, 0.005]);
/// assert_eq!(recording.max_abs("force")?, 3.0);
/// let mut text = Vec::new();
/// recording.write_csv(&mut text)?;
/// assert_eq!(text, b"time [s],position [m],force [N]\n0.0,0.0,1.0\n0.1,0.005,-3.0\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Recording {
    channels: Vec<Channel>,
    time: Vec<f64>,
    columns: Vec<Vec<f64>>,
}

impl Recording {
    /// An empty recording with memory for `rows` rows.
    ///
    /// # Errors
    /// Two channels of the same name, or more rows than memory can hold.
    pub fn new<C: Into<Channel>>(
        channels: impl IntoIterator<Item = C>,
        rows: usize,
    ) -> Result<Self, RecordingError> {
        let channels: Vec<Channel> = channels.into_iter().map(Into::into).collect();
        for (i, channel) in channels.iter().enumerate() {
            if channels[..i].iter().any(|earlier| earlier.name == channel.name) {
                return Err(RecordingError::Duplicate(channel.name.clone()));
            }
        }
        let count = channels.len();
        let reserved = || {
            let mut column = Vec::new();
            column
                .try_reserve_exact(rows)
                .map_err(|_| RecordingError::Memory { rows: rows as u64, channels: count })?;
            Ok(column)
        };
        let time = reserved()?;
        let columns = channels.iter().map(|_| reserved()).collect::<Result<_, _>>()?;
        Ok(Self { channels, time, columns })
    }

    /// Appends a row: a time in s and the value of every channel.
    ///
    /// # Errors
    /// A number of values that is not that of the channels.
    #[inline]
    pub fn push<const C: usize>(&mut self, time: f64, values: [f64; C]) -> Result<(), RecordingError> {
        if self.columns.len() != C {
            return Err(RecordingError::Row { given: C, channels: self.columns.len() });
        }
        self.time.push(time);
        for (column, value) in self.columns.iter_mut().zip(values) {
            column.push(value);
        }
        Ok(())
    }

    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.time.len()
    }

    /// Whether there is no row.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.time.is_empty()
    }

    /// Number of rows that fit without another allocation.
    #[must_use]
    pub fn capacity(&self) -> usize {
        self.columns.iter().map(Vec::capacity).fold(self.time.capacity(), usize::min)
    }

    /// The channels, in the order of their columns.
    #[must_use]
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// The time of every row, s.
    #[must_use]
    pub fn time(&self) -> &[f64] {
        &self.time
    }

    /// The values of a channel.
    ///
    /// # Errors
    /// No channel of this name.
    pub fn column(&self, name: &str) -> Result<&[f64], RecordingError> {
        self.channels
            .iter()
            .zip(&self.columns)
            .find(|(channel, _)| channel.name == name)
            .map(|(_, column)| column.as_slice())
            .ok_or_else(|| RecordingError::Unknown(name.to_owned()))
    }

    /// The largest magnitude in a channel; zero without rows, NaN with a NaN among them.
    ///
    /// # Errors
    /// No channel of this name.
    pub fn max_abs(&self, name: &str) -> Result<f64, RecordingError> {
        let column = self.column(name)?;
        Ok(column.iter().fold(0.0, |largest: f64, value| {
            if value.is_nan() || largest.is_nan() { f64::NAN } else { largest.max(value.abs()) }
        }))
    }

    /// Writes the recording as comma-separated values: a line of names and units, then the rows, every number in
    /// the shortest form that reads back as the same.
    ///
    /// # Errors
    /// What the writer says.
    pub fn write_csv(&self, mut writer: impl Write) -> io::Result<()> {
        writer.write_all(b"time [s]")?;
        for channel in &self.channels {
            write!(writer, ",{}", quoted(&format!("{} [{}]", channel.name, channel.unit)))?;
        }
        writer.write_all(b"\n")?;
        for (row, time) in self.time.iter().enumerate() {
            write!(writer, "{time:?}")?;
            for column in &self.columns {
                write!(writer, ",{:?}", column[row])?;
            }
            writer.write_all(b"\n")?;
        }
        writer.flush()
    }
}

/// A field of RFC 4180.
fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_found() {
        assert_eq!(
            Recording::new([("x", "m"), ("x", "rad")], 1),
            Err(RecordingError::Duplicate("x".to_owned()))
        );
        let mut recording = Recording::new([("x", "m")], 4).expect("valid");
        assert_eq!(recording.column("y"), Err(RecordingError::Unknown("y".to_owned())));
        assert_eq!(recording.push(0.0, [1.0, 2.0]), Err(RecordingError::Row { given: 2, channels: 1 }));
        assert!(recording.is_empty());
        assert!(recording.max_abs("x").expect("known").abs() <= 0.0);
        recording.push(0.0, [-2.0]).expect("fits");
        recording.push(1.0, [f64::NAN]).expect("fits");
        recording.push(2.0, [1.0]).expect("fits");
        assert!(recording.max_abs("x").expect("known").is_nan());
        assert_eq!((recording.len(), recording.capacity()), (3, 4));
    }

    #[test]
    fn awkward_names_are_quoted() {
        let recording = Recording::new([("a, \"b\"", "1")], 0).expect("valid");
        let mut text = Vec::new();
        recording.write_csv(&mut text).expect("a vector takes everything");
        assert_eq!(text, b"time [s],\"a, \"\"b\"\" [1]\"\n");
    }

    #[test]
    fn too_many_rows_are_an_error() {
        let result = Recording::new([("x", "m")], usize::MAX);
        assert!(matches!(result, Err(RecordingError::Memory { channels: 1, .. })));
    }
}
