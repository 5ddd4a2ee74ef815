//! The causes that are fitted to data.

use dalembert::problem::Parameter;

/// A cause, with one number `p` that is 0 where nothing is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cause {
    /// A value of the scene times `1 + p`.
    Value(Parameter),
    /// A damping that is greater by `p` per round trip.
    Damping,
    /// A spring ground of stiffness `k` with `EA/k = p L`, in place of a rigid one; in a chain at the node with this
    /// index, or at all rigid contacts.
    SoftContact(Option<usize>),
    /// A mass of `p` times that of the rod at its ends.
    EndMass,
    /// All times multiplied by `1 + p`.
    Clock,
    /// All times later by `p` round trips.
    TimeShift,
    /// A column multiplied by `1 + p`.
    Factor(usize),
    /// A column with an offset of `p` times its change in a round trip at its rate.
    Offset(usize),
}

impl Cause {
    /// Returns the place of the only column that the cause concerns.
    pub(super) fn column(self) -> Option<usize> {
        match self {
            Cause::Factor(place) | Cause::Offset(place) => Some(place),
            _ => None,
        }
    }
}

/// The causes that concern all columns, with their names.
pub(super) const GENERAL: [(&str, Cause); 12] = [
    ("wave_speed", Cause::Value(Parameter::WaveSpeed)),
    ("mass", Cause::Value(Parameter::Density)),
    ("length", Cause::Value(Parameter::Length)),
    ("start_velocity", Cause::Value(Parameter::ImpactSpeed)),
    ("gravity", Cause::Value(Parameter::Gravity)),
    ("gap", Cause::Value(Parameter::Gap)),
    ("contact_stiffness", Cause::Value(Parameter::Stiffness)),
    ("damping", Cause::Damping),
    ("soft_contact", Cause::SoftContact(None)),
    ("end_mass", Cause::EndMass),
    ("clock", Cause::Clock),
    ("time_shift", Cause::TimeShift),
];
