//! A body of a chain: its material and its start.

use crate::number::{Number, Rational, Scalar};

/// Points `(t, value)` or `(x, value)`, linear between neighbours; a repeated place is a jump.
pub type Points = Vec<(Number, Number)>;

/// An undamped elastic bar of a [`Chain`](super::Chain).
///
/// **Units**: any consistent units.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    pub(super) name: Option<String>,
    pub(super) length: Number,
    pub(super) material: BodyMaterial,
    pub(super) velocity: Points,
    pub(super) displacement: Points,
    /// Points `(x, v_x)`, in place of the displacement.
    pub(super) strain: Points,
    /// Ratio of the modulus of its waves to Young's modulus, if its sides are held; absent if both are equal.
    pub(super) constraint: Option<Rational>,
}

/// The material of a [`Body`], which sets its wave speed `c` and its impedance `Z = ρcA`.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyMaterial {
    /// Both numbers themselves.
    Impedance {
        /// `c > 0`.
        wave_speed: Number,
        /// `Z > 0`.
        impedance: Number,
    },
    /// `c = √(M/ρ)` and `Z = A√(Mρ)`.
    Elastic {
        /// `M > 0`: Young's modulus, or the constrained modulus under uniaxial strain.
        modulus: Number,
        /// `ρ > 0`.
        density: Number,
        /// `A > 0`.
        area: Number,
    },
    /// A rigid body without a length, which no wave passes.
    Rigid {
        /// `m > 0`.
        mass: Number,
    },
}

/// Returns the greatest slope between neighbours; zero for fewer than two points.
pub(crate) fn steepest(points: &[(Number, Number)]) -> f64 {
    let slope = |pair: &[(Number, Number)]| {
        let [x, v] = [pair[1].0.to_f64() - pair[0].0.to_f64(), pair[1].1.to_f64() - pair[0].1.to_f64()];
        (v / x).abs()
    };
    points.windows(2).map(slope).fold(0.0, f64::max)
}

impl Body {
    /// Returns an undeformed bar at rest, with this length, wave speed and impedance.
    pub fn new(length: Number, wave_speed: Number, impedance: Number) -> Self {
        Body::with_material(length, BodyMaterial::Impedance { wave_speed, impedance })
    }

    /// Returns an undeformed bar at rest, with this length, modulus, density and cross-section.
    pub fn elastic(length: Number, modulus: Number, density: Number, area: Number) -> Self {
        Body::with_material(length, BodyMaterial::Elastic { modulus, density, area })
    }

    /// Returns a rigid body at rest, with this mass and without a length.
    pub fn rigid(mass: Number) -> Self {
        Body::with_material(0.into(), BodyMaterial::Rigid { mass })
    }

    /// Returns the mass of a rigid body; `None` for a bar.
    pub fn rigid_mass(&self) -> Option<&Number> {
        match &self.material {
            BodyMaterial::Rigid { mass } => Some(mass),
            _ => None,
        }
    }

    pub(super) fn with_material(length: Number, material: BodyMaterial) -> Self {
        let (velocity, displacement, strain) = Default::default();
        Body { name: None, length, material, velocity, displacement, strain, constraint: None }
    }

    /// Returns the body with one velocity everywhere, upward where it is positive.
    pub fn with_velocity(self, velocity: Number) -> Self {
        let velocity = match self.material {
            BodyMaterial::Rigid { .. } => vec![(0.into(), velocity)],
            _ => vec![(0.into(), velocity.clone()), (self.length.clone(), velocity)],
        };
        Body { velocity, ..self }
    }

    /// Returns the body with a start that is linear between points `(x, v_t)` and `(x, v)`; an empty list means zero.
    pub fn with_start(self, velocity: Points, displacement: Points) -> Self {
        Body { velocity, displacement, ..self }
    }

    /// Returns the body with a displacement of the start, linear between points `(x, v)`.
    pub fn with_displacement(self, displacement: Points) -> Self {
        Body { displacement, ..self }
    }

    /// Returns the body with a strain of the start, linear between points `(x, v_x)`, in place of a displacement; its
    /// lower end is not displaced. It may jump: the same `x` twice.
    pub fn with_strain(self, strain: Points) -> Self {
        Body { strain, ..self }
    }

    /// Returns the body with a name.
    pub fn named(self, name: impl Into<String>) -> Self {
        Body { name: Some(name.into()), ..self }
    }

    /// Returns the body with this ratio of the modulus of its waves to Young's modulus; a parameter is Young's.
    pub(crate) fn with_constraint(self, constraint: Option<Rational>) -> Self {
        Body { constraint, ..self }
    }

    /// Returns the ratio of the modulus of the waves to Young's modulus, if the sides are held.
    pub(crate) fn constraint(&self) -> Option<&Rational> {
        self.constraint.as_ref()
    }

    /// Returns the name, if the body has one.
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Returns the length.
    pub fn length(&self) -> &Number {
        &self.length
    }

    /// Returns the points `(x, v_t)` of the start; none if it is at rest.
    pub fn velocity(&self) -> &[(Number, Number)] {
        &self.velocity
    }

    /// Returns the points `(x, v)` of the start; none if it is undeformed.
    pub fn displacement(&self) -> &[(Number, Number)] {
        &self.displacement
    }

    /// Returns the points `(x, v_x)` of the start; none if it is undeformed or given by its displacement.
    pub fn strain(&self) -> &[(Number, Number)] {
        &self.strain
    }

    /// Returns the body with another length.
    pub(crate) fn with_length(self, length: Number) -> Self {
        Body { length, ..self }
    }

    /// Returns the lists of points of the start, each with its key.
    pub(super) fn lists(&self) -> [(&'static str, &Points); 3] {
        [("velocity", &self.velocity), ("displacement", &self.displacement), ("strain", &self.strain)]
    }

    /// Returns the material.
    pub fn material(&self) -> &BodyMaterial {
        &self.material
    }

    /// Returns whether the body is given by its impedance, so that its stresses are forces.
    pub(crate) fn is_by_impedance(&self) -> bool {
        matches!(self.material, BodyMaterial::Impedance { .. })
    }

    /// Returns `EA/L`; `None` for a rigid body.
    pub(crate) fn stiffness(&self) -> Option<Rational> {
        let [modulus, _, area] = self.elastic_numbers();
        self.rigid_mass().is_none().then(|| modulus * area / self.length.to_rational())
    }

    /// Returns modulus, density and cross-section, which are `Zc`, `Z/c` and one for a bar that is given by its
    /// impedance; zeros for a rigid body.
    pub(crate) fn elastic_numbers(&self) -> [Rational; 3] {
        match &self.material {
            BodyMaterial::Impedance { wave_speed, impedance } => {
                let [speed, impedance] = [wave_speed, impedance].map(Number::to_rational);
                [impedance.clone() * &speed, impedance / speed, Rational::from(1)]
            }
            BodyMaterial::Elastic { modulus, density, area } => [modulus, density, area].map(Number::to_rational),
            BodyMaterial::Rigid { .. } => Default::default(),
        }
    }

    /// Returns `Z²` and `c²`, which are fractions; zero and one for a rigid body.
    pub(super) fn squares(&self) -> [Rational; 2] {
        if self.rigid_mass().is_some() {
            return [Rational::from(0), Rational::from(1)];
        }
        let [modulus, density, area] = self.elastic_numbers();
        [Scalar::square(&area) * &modulus * &density, modulus / density]
    }
}
