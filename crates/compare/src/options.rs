//! Conventions of data, and their conversion to the signs, origins and factors of the library.

use super::reference::Reference;
use dalembert::Error;
use dalembert::number::Number;
use dalembert::problem::Parameter;
use dalembert::quantity::{Measure, Quantity};

/// The sign of compression in data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Compression {
    /// Forces, stresses and strains are positive in compression
    #[value(name = "+", alias = "positive")]
    Positive,
    /// They are negative
    #[value(name = "-", alias = "negative")]
    Negative,
}

/// The place in data at which displacements are zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Origin {
    /// The place of the undeformed rod on the ground
    #[default]
    Ground,
    /// The place of the rod at t = 0
    Start,
}

/// The direction in which displacements and velocities of data are positive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Axis {
    /// Away from the ground
    #[default]
    Up,
    /// Towards the ground
    Down,
}

/// The conventions of data, and the tasks of a comparison; messages use these names.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Options {
    /// Column of each quantity, by its name or its number from 0: t=0,u=1,force=f_n; by default the names of the
    /// columns
    #[arg(long, value_name = "NAME=COLUMN,…")]
    pub map: Option<String>,
    /// Step between rows, where no column holds the time
    #[arg(long, value_name = "DT", allow_hyphen_values = true)]
    pub dt: Option<Number>,
    /// Time of the first row, with --dt
    #[arg(long, value_name = "T", requires = "dt", allow_hyphen_values = true)]
    pub t0: Option<Number>,
    /// Time added to the times of the data
    #[arg(long, value_name = "DT", allow_hyphen_values = true)]
    pub shift: Option<Number>,
    /// Sign of forces, stresses and strains in compression; by default forces are +, stresses and strains −
    #[arg(long, value_enum, value_name = "SIGN", allow_hyphen_values = true)]
    pub compression: Option<Compression>,
    /// Place at which displacements are zero
    #[arg(long = "u-origin", value_enum, value_name = "U_ORIGIN", default_value_t)]
    pub origin: Origin,
    /// Direction in which displacements and velocities are positive
    #[arg(long, value_enum, default_value_t)]
    pub axis: Axis,
    /// Factor that brings the energies of the data to those of the rod
    #[arg(long, value_name = "FACTOR", default_value = "1", allow_hyphen_values = true)]
    pub energy_scale: Option<Number>,
    /// Round trips from a jump where `L∞ off jumps` begins; by default 0.02, or two steps where that is more
    #[arg(long, value_name = "TRIPS", allow_hyphen_values = true)]
    pub window: Option<Number>,
    /// Width of the mesh of each file, for the order of convergence; by default the step of its times
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub widths: Vec<Number>,
    /// Values of the scene to fit to the data: length, wave_speed, modulus, density, damping, gravity, impact_speed,
    /// gap, and the stiffness of a contact that yields
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = Parameter::differentiable)]
    pub fit: Vec<Parameter>,
    /// Stiffness of the contact of the data, of the whole cross-section: ours then yields alike, and the report says
    /// what the stiffness explains
    #[arg(long, value_name = "K")]
    pub contact_stiffness: Option<Number>,
    /// Time to which the data are to go; by default the end of the run of the scene
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub to: Option<Number>,
}

impl Options {
    /// Returns the factor that brings a quantity to the convention of the library: forces are positive in compression,
    /// strains and stresses in tension.
    fn factor(&self, quantity: Quantity) -> f64 {
        let is_reversed = match quantity.measure() {
            Some(Measure::Length | Measure::Velocity) => self.axis == Axis::Down,
            Some(Measure::Strain | Measure::Stress) => self.compression == Some(Compression::Positive),
            Some(Measure::Force | Measure::Impulse) => self.compression == Some(Compression::Negative),
            Some(Measure::Energy) => return self.energy_scale.as_ref().map_or(1.0, Number::to_f64),
            Some(Measure::Time) | None => false,
        };
        if is_reversed { -1.0 } else { 1.0 }
    }

    /// Brings all quantities to the conventions of the library.
    pub(super) fn apply(
        &self,
        reference: &Reference<'_>,
        quantities: &mut [(Quantity, Vec<f64>)],
        points: Option<&[f64]>,
    ) -> Result<(), Error> {
        for (what, values) in quantities {
            let factor = self.factor(*what);
            let starts = if self.origin == Origin::Start { reference.start(*what, points)? } else { None };
            for (k, value) in values.iter_mut().enumerate() {
                *value *= factor;
                if let Some(starts) = &starts {
                    *value += starts[k.min(starts.len() - 1)];
                }
            }
        }
        Ok(())
    }
}
