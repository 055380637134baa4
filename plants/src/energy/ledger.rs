//! The balance of a motion.

/// The energy balance of a plant over a motion: `input = stored + dissipated + delivered`, every term in J.
///
/// A model whose ledger does not close has a wrong equation, whatever its step.
///
/// ```
/// use plants::EnergyLedger;
///
/// let mut ledger = EnergyLedger::default();
/// ledger.input += 3.0;
/// ledger.stored += 2.0;
/// ledger.dissipated += 0.75;
/// assert_eq!(ledger.imbalance(), 0.25);
/// assert_eq!(ledger.relative_imbalance(), 0.25 / 3.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct EnergyLedger {
    /// Work done by the input on the plant, J.
    pub input: f64,
    /// Growth of the energy stored in the plant, J.
    pub stored: f64,
    /// Energy turned into heat, J.
    pub dissipated: f64,
    /// Work done by the plant on its load, J.
    pub delivered: f64,
}

impl EnergyLedger {
    /// Adds what flowed over an interval.
    pub(crate) fn add(&mut self, flow: &Self) {
        self.input += flow.input;
        self.stored += flow.stored;
        self.dissipated += flow.dissipated;
        self.delivered += flow.delivered;
    }

    /// What is unaccounted for, J: `input - stored - dissipated - delivered`.
    #[must_use]
    pub fn imbalance(&self) -> f64 {
        self.input - self.stored - self.dissipated - self.delivered
    }

    /// The magnitude of the imbalance over that of the largest term; zero when nothing moved.
    #[must_use]
    pub fn relative_imbalance(&self) -> f64 {
        let largest = [self.input, self.stored, self.dissipated, self.delivered]
            .into_iter()
            .fold(0.0_f64, |largest, term| largest.max(term.abs()));
        if largest > 0.0 { self.imbalance().abs() / largest } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_balanced() {
        assert!(EnergyLedger::default().relative_imbalance().abs() <= 0.0);
    }

    #[test]
    fn what_is_delivered_counts() {
        let ledger = EnergyLedger { input: 10.0, stored: -2.0, dissipated: 5.0, delivered: 7.0 };
        assert!(ledger.imbalance().abs() <= 0.0);
        let ledger = EnergyLedger { delivered: 6.0, ..ledger };
        assert!((ledger.relative_imbalance() - 0.1).abs() <= f64::EPSILON);
    }
}
