//! The one set of checks that every problem goes through, from a scene file or from the builder.

use super::given::{ByParameter, Given, UNITS, range, within};
use super::in_chain::InChain;
use super::parameters::touch_speed;
use super::profile::{self, Points};
use super::{
    Material, Parameter, Problem, ProblemError, ProblemErrorKind as Kind, Profile, Run, Speed, Start, Top, Written,
};
use crate::number::{Number, Rational};

pub(super) const IMPACT: &[Parameter] = &[Parameter::ImpactSpeed, Parameter::Gap, Parameter::DropHeight];

const DAMPING_RATIO: (f64, f64) = (1e-305, 1e6);
const SPEED_RATIO: (f64, f64) = (1e-12, 1e12);
/// Maximum length of a run in round trips.
const MAX_ROUND_TRIPS: f64 = 1e12;
const MAX_IMPACTS: u32 = 10_000_000;
/// A fall is followed trip by trip, like every flight that ends in a touch.
const MAX_FALL: f64 = 1e6;

/// Refuses a time, written as `shown`, that no run of a rod with the round trip `t1` reaches.
pub(crate) fn check_time(time: &Number, shown: &str, t1: f64) -> Result<(), ProblemError> {
    let round_trips = time.to_f64() / t1;
    if round_trips <= MAX_ROUND_TRIPS {
        return Ok(());
    }
    let found = format!("time = {shown}, which is {round_trips:e} round trips");
    let expected = format!("at most {MAX_ROUND_TRIPS:e} round trips of 2L/c");
    Err(Parameter::Time.error(Kind::Combination, found, expected))
}

/// The values of a problem before any check.
#[derive(Clone, Debug, Default)]
pub(crate) struct Draft {
    /// Whether messages use the keys of a scene file; otherwise the setters of the builder.
    pub(crate) from_scene: bool,
    /// Parameters that are one number.
    pub(crate) numbers: ByParameter<Written>,
    /// Displacement, strain and velocity at the start.
    pub(crate) profiles: ByParameter<Points>,
    pub(crate) top: Option<Top>,
    /// The chain that the body is part of.
    pub(crate) in_chain: Option<InChain>,
}

impl Draft {
    /// Returns the problem, if all values and their combinations are within the [limits](crate::problem#limits).
    pub(crate) fn check(&self) -> Result<Problem, ProblemError> {
        let number = |given: &Option<Given<'_>>| given.as_ref().map(|given| given.number.clone());
        let length = self.required(Parameter::Length)?;
        let material = self.material()?;
        let damping = self.non_negative(Parameter::Damping)?;
        let gravity = self.non_negative(Parameter::Gravity)?;

        let t1 = material.round_trip(length.number);
        length.makes("the round trip 2L/c = ", t1, UNITS, "one")?;
        let g = gravity.as_ref().map_or(0.0, |g| g.number.to_f64());
        if let Some(gravity) = &gravity {
            gravity.makes("g t₁ = ", g * t1, UNITS, "a speed")?;
        }
        if let Some(damping) = &damping {
            damping.makes("r t₁ = ", damping.number.to_f64() * t1, DAMPING_RATIO, "zero or a value")?;
        }
        let problem = Problem {
            start: match &self.in_chain {
                Some(_) => Start::Profile(self.profile(length.number)?),
                None => self.start(length.number, t1, g)?,
            },
            run: self.run(t1)?,
            length: length.number.clone(),
            material,
            damping: number(&damping),
            top: self.top.unwrap_or_default(),
            gravity: number(&gravity),
            in_chain: self.place_in_chain()?,
        };
        problem.checked_in_chain()
    }

    /// Stretches the points of the start to another length.
    pub(super) fn stretch(&mut self, length: &Written) {
        let number = |written: &Written| written.number.as_ref().ok().cloned().map(|number| number.to_rational());
        let old = self.numbers.get(&Parameter::Length).and_then(number);
        let Some((old, new)) = old.zip(number(length)).filter(|(old, _)| *old > Rational::default()) else { return };
        for (x, _) in self.profiles.values_mut().flatten() {
            let stretched = number(x).and_then(|x| Number::of_rational(&(x * &new / &old)));
            if let Some(stretched) = stretched {
                *x = stretched.into();
            }
        }
    }

    fn material(&self) -> Result<Material, ProblemError> {
        const EITHER: &str = "wave_speed, or a material: modulus and density";
        let first =
            [Parameter::Modulus, Parameter::Density, Parameter::Area].into_iter().find(|other| self.has(*other));
        match (self.positive(Parameter::WaveSpeed)?, first) {
            (Some(c), None) => return Ok(Material::WaveSpeed(c.number.clone())),
            (Some(_), Some(other)) => {
                let found = format!("{} as well as wave_speed", self.name(other));
                return Err(other.error(Kind::Contradiction, found, format!("either {EITHER}")));
            }
            (None, None) => return Err(ProblemError::new(Kind::Missing, "rod", "no wave speed", EITHER)),
            (None, Some(_)) => {}
        }
        let modulus = self.required(Parameter::Modulus)?.number.clone();
        let density = self.required(Parameter::Density)?.number.clone();
        let area = self.positive(Parameter::Area)?.map(|area| area.number.clone());
        Ok(Material::Elastic { modulus, density, area })
    }

    /// Returns the chain that the body is part of, with the stiffness of the spring below it.
    fn place_in_chain(&self) -> Result<Option<InChain>, ProblemError> {
        if !self.has(Parameter::Stiffness) {
            return Ok(self.in_chain.clone());
        }
        let none = Number::from(0);
        let positive = self.non_negative(Parameter::Stiffness)?;
        if positive.is_none() && self.in_chain.as_ref().is_some_and(|place| !place.is_damped()) {
            let found = "stiffness = 0 and no damping below the rod";
            return Err(Parameter::Stiffness.error(Kind::Contradiction, found, "one of them above zero"));
        }
        let stiffness = positive.as_ref().map_or(&none, |given| given.number);
        let place = self.in_chain.as_ref().and_then(|place| place.with_stiffness(stiffness));
        place.map(Some).ok_or_else(|| {
            let found = "a stiffness of rigid ground";
            let expected = "a rod on a spring: a scene with [ground] stiffness, or Problem::on_spring";
            Parameter::Stiffness.error(Kind::Contradiction, found, expected)
        })
    }

    /// The start of a body of a chain, whose displacement may have either sign.
    fn profile(&self, length: &Number) -> Result<Profile, ProblemError> {
        if let Some(impact) = IMPACT.iter().find(|parameter| self.has(**parameter)) {
            let found = format!("{} of a body of a chain", self.name(*impact));
            let expected = "a velocity and a displacement of the start";
            return Err(impact.error(Kind::Contradiction, found, expected));
        }
        profile::check(&self.profiles, length, false)
    }

    /// The motion at `t = 0` of a rod with this length and round trip under the gravity `g`.
    fn start(&self, length: &Number, t1: f64, g: f64) -> Result<Start, ProblemError> {
        let impact = IMPACT.iter().any(|parameter| self.has(*parameter));
        match (impact, !self.profiles.is_empty()) {
            (true, false) => match self.non_negative(Parameter::Gap)? {
                Some(gap) => self.above(&gap, t1, g),
                None => self.impact(t1, g).map(Start::Uniform),
            },
            (false, true) => profile::check(&self.profiles, length, true).map(Start::Profile),
            (true, true) => {
                let found =
                    self.word("start as well as [impact]", "a displacement, strain or velocity as well as an impact");
                let expected = self.word(
                    "either [impact], for a uniform start, or [start]",
                    "either impact_speed or drop_height, for a uniform start, or displacement or strain, and velocity",
                );
                Err(ProblemError::new(Kind::Contradiction, "start", found, expected))
            }
            (false, false) => {
                let found = self.word("neither [impact] nor [start]", "no start");
                let expected = self.word(
                    "[impact] with speed or drop_height, or [start]",
                    "impact_speed, drop_height, displacement, strain or velocity",
                );
                Err(ProblemError::new(Kind::Missing, "", found, expected))
            }
        }
    }

    fn above(&self, gap: &Given<'_>, t1: f64, g: f64) -> Result<Start, ProblemError> {
        let key = self.name(Parameter::ImpactSpeed);
        if self.has(Parameter::DropHeight) {
            let expected = format!("gap with {key}; a rod dropped from rest at t = 0 has {key} = 0");
            return Err(Parameter::Gap.error(Kind::Contradiction, "gap as well as drop_height", expected));
        }
        if !self.has(Parameter::ImpactSpeed) {
            let expected = format!("{key} at t = 0 as well; zero for a rod dropped from rest");
            return Err(Parameter::Gap.error(Kind::Missing, format!("gap without {key}"), expected));
        }
        let speed = match self.non_negative(Parameter::ImpactSpeed)? {
            None if g == 0.0 => {
                let gravity = self.word("[gravity] with an acceleration above zero", "a gravity above zero");
                let expected = format!("a speed above zero, or {gravity}: otherwise nothing moves");
                let found = format!("{key} = 0 without gravity");
                return Err(Parameter::ImpactSpeed.error(Kind::OutOfRange, found, expected));
            }
            given => given.map_or(Number::from(0), |given| given.number.clone()),
        };
        let touch = touch_speed(gap.number, &speed, g);
        gap.makes("the speed at the ground ", touch, UNITS, "one")?;
        if g > 0.0 {
            gap.makes("μ/(g t₁) at the ground ", touch / (g * t1), SPEED_RATIO, "a value")?;
        }
        let trips = 2.0 * gap.number.to_f64() / (speed.to_f64() + touch) / t1;
        if trips > MAX_FALL && self.top.unwrap_or_default() == Top::Free {
            let note = format!(", which is {trips:.3e} round trips of falling");
            let expected =
                format!("at most {MAX_FALL:e} round trips of 2L/c; or the speed at the ground without a gap");
            return Err(gap.error(Kind::Combination, &note, expected));
        }
        Ok(Start::Above { gap: gap.number.clone(), speed })
    }

    fn impact(&self, t1: f64, g: f64) -> Result<Speed, ProblemError> {
        let key = self.name(Parameter::ImpactSpeed);
        let given = self.given(Parameter::ImpactSpeed)?.map(|given| given.positive("an impact speed")).transpose()?;
        let height = self.positive(Parameter::DropHeight)?;
        let (given, speed) = match (given, height) {
            (Some(given), None) => (Speed::Given(given.number.clone()), given),
            (None, Some(height)) if g > 0.0 => (Speed::DropHeight(height.number.clone()), height),
            (None, _) => {
                let gravity = self.word("[gravity] with an acceleration", "a gravity");
                let expected = format!("{gravity} above zero, or {key} in place of drop_height");
                return Err(Parameter::DropHeight.error(Kind::Missing, "drop_height without gravity", expected));
            }
            (Some(_), Some(_)) => {
                let found = format!("drop_height as well as {key}");
                let expected = format!("either {key} or drop_height");
                return Err(Parameter::DropHeight.error(Kind::Contradiction, found, expected));
            }
        };
        let value = given.value(g);
        speed.makes("the impact speed ", value, UNITS, "one")?;
        if g > 0.0 {
            speed.makes("μ/(g t₁) = ", value / (g * t1), SPEED_RATIO, "a value")?;
        }
        Ok(given)
    }

    fn run(&self, t1: f64) -> Result<Run, ProblemError> {
        if let Some(time) = self.positive(Parameter::Time)? {
            if self.has(Parameter::Impacts) {
                let found = "impacts as well as time";
                return Err(Parameter::Impacts.error(Kind::Contradiction, found, "either time or impacts"));
            }
            check_time(time.number, time.shown, t1)?;
            return Ok(Run::Time(time.number.clone()));
        }
        let Some(impacts) = self.numbers.get(&Parameter::Impacts) else { return Ok(Run::Impacts(1)) };
        let whole = impacts.number.as_ref().ok().and_then(|number| number.to_string().parse().ok());
        whole.filter(|n| (1..=MAX_IMPACTS).contains(n)).map(Run::Impacts).ok_or_else(|| {
            let expected = format!("a whole number from 1 to {MAX_IMPACTS}");
            Parameter::Impacts.error(Kind::OutOfRange, format!("impacts = {}", impacts.shown), expected)
        })
    }

    pub(super) fn has(&self, parameter: Parameter) -> bool {
        self.numbers.contains_key(&parameter)
    }

    fn given(&self, parameter: Parameter) -> Result<Option<Given<'_>>, ProblemError> {
        self.numbers
            .get(&parameter)
            .map(|written| Given::new(parameter.path(), self.name(parameter), written))
            .transpose()
    }

    /// A value above zero, if it is given.
    fn positive(&self, parameter: Parameter) -> Result<Option<Given<'_>>, ProblemError> {
        self.given(parameter)?.map(|given| given.positive(parameter.noun())).transpose()
    }

    fn required(&self, parameter: Parameter) -> Result<Given<'_>, ProblemError> {
        self.positive(parameter)?.ok_or_else(|| {
            let expected = format!("{} above zero", parameter.noun());
            ProblemError::new(Kind::Missing, "rod", format!("no {}", self.name(parameter)), expected)
        })
    }

    /// A value that is not negative, if it is given and not zero.
    fn non_negative(&self, parameter: Parameter) -> Result<Option<Given<'_>>, ProblemError> {
        let Some(given) = self.given(parameter)? else { return Ok(None) };
        let x = given.number.to_f64();
        if x < 0.0 {
            return Err(given.error(Kind::OutOfRange, "", format!("{} of zero or more", parameter.noun())));
        }
        // A damping is held to the range of r t₁ alone: weak ones are asked for on purpose.
        if x > 0.0 && parameter != Parameter::Damping && !within(x, UNITS) {
            return Err(given.error(Kind::OutOfRange, "", format!("zero or {} {}", parameter.noun(), range(UNITS))));
        }
        Ok(Some(given).filter(|_| x > 0.0))
    }

    fn name(&self, parameter: Parameter) -> &'static str {
        if self.from_scene { parameter.table_and_key().1 } else { parameter.name() }
    }

    fn word(&self, scene: &'static str, builder: &'static str) -> &'static str {
        if self.from_scene { scene } else { builder }
    }
}
