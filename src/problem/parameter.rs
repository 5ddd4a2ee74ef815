//! The table of parameters: the only place where their names are spelled. The scene reader, the builder, derivatives,
//! sweeps and the Python module follow from it.

use std::fmt;
use std::str::FromStr;

use super::{Builder, Problem, ProblemError, ProblemErrorKind as Kind, Start, Written};
use crate::chain::{ChainParameter, ChainValue};
use crate::names::{UnknownName, nearest};
use crate::number::Number;

struct Names {
    /// The path in a scene file.
    path: &'static str,
    /// The name of the setter of the [`Builder`] and of the field in Python.
    field: &'static str,
    /// The kind of value, with its article, in messages.
    noun: &'static str,
    /// Words for it that are no names, in lower case: a message suggests the name in their place.
    synonyms: &'static [&'static str],
    /// Whether derivatives are taken by it.
    is_differentiable: bool,
}

macro_rules! parameters {
    ($(
        $(#[doc = $doc:literal])+
        $kind:ident $parameter:ident: $path:literal, $field:ident, $noun:literal, $synonyms:tt;
    )+) => {
        /// A parameter of a problem. Derivatives are taken by it, sweeps vary it, and data are fitted with it.
        ///
        /// ```
        /// use dalembert::Parameter;
        /// assert_eq!("impact.speed".parse(), Ok(Parameter::ImpactSpeed));
        /// assert_eq!("impact_speed".parse(), Ok(Parameter::ImpactSpeed));
        /// assert_eq!(Parameter::Velocity(Some(2)).to_string(), "velocity[2]");
        /// let error = "speed".parse::<Parameter>().unwrap_err();
        /// assert_eq!(error.nearest.as_deref(), Some("impact_speed"));
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Parameter {
            $($(#[doc = $doc])+ $parameter,)+
            /// `v(x,0)`, a list of points: a factor of all values, 1 as they are, or the value at one point, counted
            /// from 0.
            Displacement(Option<usize>),
            /// `v_x(x,0)`, as the displacement.
            Strain(Option<usize>),
            /// `v_t(x,0)`, as the displacement.
            Velocity(Option<usize>),
            /// A value of the chain that the rod is a body of.
            OfChain(ChainParameter),
        }

        impl Parameter {
            /// All parameters of a rod by itself, in the order of messages.
            pub const ALL: &'static [Parameter] = &[
                $(Parameter::$parameter,)+
                Parameter::Displacement(None), Parameter::Strain(None), Parameter::Velocity(None),
            ];

            fn names(self) -> Names {
                let names = |path, field, noun, synonyms: &'static [&'static str]| {
                    Names { path, field, noun, synonyms, is_differentiable: true }
                };
                match self {
                    $(Parameter::$parameter => Names {
                        is_differentiable: parameters!(differentiable $kind),
                        ..names($path, stringify!($field), $noun, &$synonyms)
                    },)+
                    Parameter::Displacement(_) => {
                        let synonyms = &["u", "v", "deformation", "position"];
                        names("start.displacement", "displacement", "a displacement", synonyms)
                    }
                    Parameter::Strain(_) => {
                        names("start.strain", "strain", "a strain", &["prestrain", "initial_strain", "v_x", "u_x"])
                    }
                    Parameter::Velocity(_) => names("start.velocity", "velocity", "a velocity", &[]),
                    Parameter::OfChain(parameter) => {
                        let path = chain_path(parameter.value());
                        names(path, path, "a value", &[])
                    }
                }
            }
        }

        /// Setters of single numbers.
        impl Builder {
            $(parameters!(setter $kind $(#[doc = $doc])+ $parameter $field);)+
        }
    };
    (setter number $(#[doc = $doc:literal])+ $parameter:ident $field:ident) => {
        $(#[doc = $doc])+
        #[must_use]
        pub fn $field(self, value: impl Into<Written>) -> Self {
            self.set(Parameter::$parameter, value)
        }
    };
    (setter setting $(#[doc = $doc:literal])+ $parameter:ident $field:ident) => {
        parameters!(setter number $(#[doc = $doc])+ $parameter $field);
    };
    (setter choice $(#[doc = $doc:literal])+ $parameter:ident $field:ident) => {};
    (differentiable number) => { true };
    (differentiable $other:ident) => { false };
}

// Derivatives are taken by a `number`. A `setting` is a number that nothing of the motion up to its end depends on, or
// only through another one.
parameters! {
    /// `L > 0`: the length.
    number Length: "rod.length", length, "a length", ["l", "size"];
    /// `c > 0`: the wave speed. Either this or the [`material`](Builder::material).
    number WaveSpeed: "rod.wave_speed", wave_speed, "a wave speed",
        ["c", "c0", "sound_speed", "speed_of_sound", "wave_velocity"];
    /// `E > 0`: Young's modulus, with the density in place of the wave speed: `c = √(E/ρ)`.
    number Modulus: "rod.modulus", modulus, "a modulus",
        ["e", "young", "youngs_modulus", "young_modulus", "elastic_modulus"];
    /// `ρ > 0`: the density.
    number Density: "rod.density", density, "a density", ["rho", "ρ", "mass_density"];
    /// `S > 0`: the cross-section; without it forces, impulses and energies are those of a unit of it.
    setting Area: "rod.area", area, "an area", ["a", "s", "cross_section", "section"];
    /// `r ≥ 0`: the damping; without it none.
    number Damping: "rod.damping", damping, "a damping", ["r", "damping_ratio", "friction"];
    /// The end `x = L`, free or fixed.
    choice Top: "rod.top", top, "a top", ["clamped", "fixed", "fixed_top", "end", "boundary", "support"];
    /// `μ > 0`: the speed with which the undeformed rod hits the ground at `t = 0`; with a [`gap`](Builder::gap)
    /// its speed downwards at `t = 0`, which may be zero under gravity.
    number ImpactSpeed: "impact.speed", impact_speed, "a speed",
        ["mu", "μ", "µ", "v0", "impact_speed", "impact_velocity", "initial_velocity"];
    /// The undeformed rod starts this far above the ground, and `t = 0` is that start, not the first touch.
    number Gap: "impact.gap", gap, "a gap", ["clearance", "distance", "initial_gap", "jeu", "d0"];
    /// `h > 0`: a fall from rest through this height, without air drag or damping: `μ = √(2 g h)`. The fall is over
    /// at `t = 0`, the first touch.
    setting DropHeight: "impact.drop_height", drop_height, "a drop height", ["h", "height", "fall_height"];
    /// `g ≥ 0`: the acceleration of gravity; without it none.
    number Gravity: "gravity.acceleration", gravity, "an acceleration", ["g"];
    /// `k ≥ 0`: the stiffness of the spring that yields below a body of a chain, the whole of it: a force per length.
    /// Only bodies that stand on a spring have one.
    number Stiffness: "ground.stiffness", stiffness, "a stiffness",
        ["k", "spring", "penalty", "contact_stiffness", "spring_constant"];
    /// The time up to which to follow the motion, which is included.
    setting Time: "run.time", time, "a time", ["t", "t_end", "end_time", "duration", "until"];
    /// The number of contacts to follow, each with the flight after it; without it and without a `time`, one.
    setting Impacts: "run.impacts", impacts, "a number of impacts", ["n", "bounces", "contacts", "hits"];
}

impl Parameter {
    /// Returns the path in a scene file: `impact.speed`; that of the list for one of its points.
    pub fn path(self) -> &'static str {
        self.names().path
    }

    /// Returns the path with the place of a point or of a body: `start.velocity[2]`, `body.2.length`.
    pub fn full_path(self) -> String {
        match (self, self.point()) {
            (Parameter::OfChain(parameter), _) => parameter.to_string(),
            (_, Some(point)) => format!("{}[{point}]", self.path()),
            (_, None) => self.path().to_string(),
        }
    }

    /// Returns the name of the setter of the [`Builder`] and of the field in Python: `impact_speed`; that of the list
    /// for one of its points.
    pub fn name(self) -> &'static str {
        self.names().field
    }

    /// Builds the error of its value in a problem.
    pub(super) fn error(self, kind: Kind, found: impl Into<String>, expected: impl Into<String>) -> ProblemError {
        ProblemError::new(kind, self.path(), found, expected)
    }

    /// Returns the kind of value, with its article: `a length`.
    pub(super) fn noun(self) -> &'static str {
        self.names().noun
    }

    /// Returns the table and the key of the path: `impact` and `speed`.
    pub(crate) fn table_and_key(self) -> (&'static str, &'static str) {
        self.path().split_once('.').unwrap_or(("", self.path()))
    }

    /// Returns whether derivatives are taken by it: the motion depends on it by itself.
    pub fn is_differentiable(self) -> bool {
        self.names().is_differentiable
    }

    /// Returns the parameters that derivatives are taken by, with a list of points as a whole.
    pub fn all_differentiable() -> impl Iterator<Item = Parameter> + Clone {
        Parameter::ALL.iter().copied().filter(|parameter| parameter.is_differentiable())
    }

    /// Reads the path or the field of a parameter that derivatives are taken by.
    ///
    /// **Errors**: [`UnknownName`] with those that derivatives are taken by, also for a parameter that is none of them.
    ///
    /// ```
    /// use dalembert::Parameter;
    /// assert_eq!(Parameter::differentiable("rod.length"), Ok(Parameter::Length));
    /// assert!(!Parameter::differentiable("area").unwrap_err().known.contains(&"area"));
    /// ```
    pub fn differentiable(text: &str) -> Result<Self, UnknownName> {
        let names = || Parameter::all_differentiable().map(Parameter::name);
        match text.parse::<Parameter>() {
            Ok(parameter) if parameter.is_differentiable() => Ok(parameter),
            Ok(_) => Err(UnknownName { nearest: None, ..UnknownName::new("parameter", text, names()) }),
            Err(error) => Err(UnknownName { known: names().collect(), ..error }),
        }
    }

    /// Returns the words that a message answers with this parameter.
    pub(crate) fn synonyms(self) -> &'static [&'static str] {
        self.names().synonyms
    }

    /// Returns whether it is one number: no list of points, and no choice.
    pub fn is_number(self) -> bool {
        !matches!(self, Parameter::Top) && !Parameter::LISTS.contains(&self.whole())
    }

    /// The parameters that are lists of points.
    pub(crate) const LISTS: [Parameter; 3] =
        [Parameter::Displacement(None), Parameter::Strain(None), Parameter::Velocity(None)];

    /// Returns the list that a point of the start is of; any other parameter as it is.
    fn whole(self) -> Self {
        match self {
            Parameter::Displacement(_) => Parameter::Displacement(None),
            Parameter::Strain(_) => Parameter::Strain(None),
            Parameter::Velocity(_) => Parameter::Velocity(None),
            _ => self,
        }
    }

    /// Returns the parameters that are one number.
    pub fn numbers() -> impl Iterator<Item = Parameter> + Clone {
        Parameter::ALL.iter().copied().filter(|parameter| parameter.is_number())
    }

    /// Returns the points `(x, value)` of the list that this parameter is, or is a point of; `None` where `problem` has
    /// no profile.
    pub fn list(self, problem: &Problem) -> Option<&[(Number, Number)]> {
        let Start::Profile(profile) = &problem.start else { return None };
        match self {
            Parameter::Displacement(_) => Some(&profile.displacement),
            Parameter::Strain(_) => Some(&profile.strain),
            Parameter::Velocity(_) => Some(&profile.velocity),
            _ => None,
        }
    }

    /// Returns the place of the point in its list, for a point of the start.
    pub(super) fn point(self) -> Option<usize> {
        match self {
            Parameter::Displacement(point) | Parameter::Strain(point) | Parameter::Velocity(point) => point,
            _ => None,
        }
    }

    /// Returns the parameter with this path or field.
    fn named(name: &str) -> Option<Self> {
        Parameter::ALL.iter().copied().find(|parameter| parameter.path() == name || parameter.name() == name)
    }
}

/// Returns the value of a chain that a text with a place of a chain was most likely meant to be.
fn chain_nearest(text: &str) -> Option<String> {
    let (place, word) = text.rsplit_once('.')?;
    let values = <ChainValue as strum::VariantArray>::VARIANTS.iter().copied();
    let near = |value: ChainValue| format!("{place}.{value}");
    let known: Vec<String> = values.map(near).filter(|text| text.parse::<ChainParameter>().is_ok()).collect();
    nearest(&format!("{place}.{word}"), known.iter().map(String::as_str)).map(String::from)
}

/// Returns the path of a value of a chain without its place.
fn chain_path(value: ChainValue) -> &'static str {
    match value {
        ChainValue::Length => "body.length",
        ChainValue::WaveSpeed => "body.wave_speed",
        ChainValue::Impedance => "body.impedance",
        ChainValue::Modulus => "body.modulus",
        ChainValue::Density => "body.density",
        ChainValue::Area => "body.area",
        ChainValue::Mass => "body.mass",
        ChainValue::Velocity => "body.velocity",
        ChainValue::Gap => "joint.gap",
        ChainValue::Stiffness => "joint.stiffness",
        ChainValue::Damping => "joint.damping",
    }
}

/// The [field](Parameter::name), with the place of a point: `velocity[0]`.
impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self, self.point()) {
            (Parameter::OfChain(parameter), _) => parameter.fmt(f),
            (_, Some(point)) => f.pad(&format!("{}[{point}]", self.name())),
            (_, None) => f.pad(self.name()),
        }
    }
}

/// Reads a path or a field, with the place of a point behind it: `impact.speed`, `impact_speed`, `start.velocity[0]`;
/// or a value of a chain: `body.2.length`, `joint.1.gap`.
impl FromStr for Parameter {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, UnknownName> {
        let text = text.trim();
        let (name, point) = match text.strip_suffix(']').and_then(|text| text.split_once('[')) {
            Some((name, point)) => (name, Some(point.parse::<usize>().ok())),
            None => (text, None),
        };
        // The stiffness below a rod is a value of its own.
        if let (None, Ok(parameter)) = (Parameter::named(text), text.parse::<ChainParameter>()) {
            return Ok(Parameter::OfChain(parameter));
        }
        let found = match (Parameter::named(name), point) {
            (found, None) => found,
            (Some(Parameter::Displacement(_)), Some(Some(k))) => Some(Parameter::Displacement(Some(k))),
            (Some(Parameter::Strain(_)), Some(Some(k))) => Some(Parameter::Strain(Some(k))),
            (Some(Parameter::Velocity(_)), Some(Some(k))) => Some(Parameter::Velocity(Some(k))),
            _ => None,
        };
        found.ok_or_else(|| {
            let all = || Parameter::ALL.iter().copied();
            let mut error = UnknownName::new("parameter", text, all().map(Parameter::name));
            // A path that is misspelt is answered with a path.
            let path = || nearest(text, all().map(Parameter::path)).map(String::from);
            // The key of a path.
            let word = text.rsplit('.').next().unwrap_or(text).to_lowercase();
            let meant = all().find(|known| known.table_and_key().1 == word || known.synonyms().contains(&&*word));
            error.nearest = error
                .nearest
                .or_else(|| chain_nearest(text))
                .or_else(path)
                .or_else(|| meant.map(|known| known.name().into()));
            error
        })
    }
}
