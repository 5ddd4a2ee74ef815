//! Values that others have published for a scene: data beside it, in `[[target]]`.

use std::ops::Range;

use super::error::SceneError;
use super::reader::{Reader, Value};
use crate::motion::Side;
use crate::names::nearest;
use crate::number::Number;
use crate::problem::ProblemErrorKind as Kind;
use crate::quantity::{Measure, Needs, Quantity};

/// A value that others have published for a scene.
///
/// **Units**: those of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The quantity that was published.
    pub quantity: Quantity,
    /// `t`, for what has a value at every time.
    pub time: Option<Number>,
    /// The limit, where there are two.
    pub side: Side,
    /// The number of the contact, from 1, for a quantity of a contact.
    pub contact: usize,
    /// Whether a displacement is counted from where the rod starts, and not from where it is undeformed on the ground.
    pub from_start: bool,
    /// The published value, with the digits that were published.
    pub published: Number,
    /// Tolerance of the published value; without it, half a unit of its last digit, or nothing for a fraction.
    pub within: Option<Number>,
    /// The publication.
    pub source: String,
}

impl Target {
    /// Returns the quantity in words: `u_top from the start`, `release 2`.
    pub fn label(&self) -> String {
        let mut label = self.quantity.name().to_string();
        if self.contact > 1 {
            label += &format!(" {}", self.contact);
        }
        if self.side == Side::Left {
            label += " from the left";
        }
        if self.from_start {
            label += " from the start";
        }
        label
    }

    /// Returns the tolerance of the published value: the one that is given, or half a unit of its last digit; zero for
    /// a fraction.
    ///
    /// ```
    /// use dalembert::Scene;
    /// let scene = "[rod]\nlength = 1\nwave_speed = 3\n[impact]\nspeed = 1\n\
    ///              [[target]]\nquantity = 'release'\npublished = 6.67e-1\nsource = 'by hand'\n";
    /// assert!((Scene::parse(scene)?.targets[0].tolerance() - 0.0005).abs() < 1e-15);
    /// # Ok::<(), dalembert::SceneError>(())
    /// ```
    pub fn tolerance(&self) -> f64 {
        if let Some(within) = &self.within {
            return within.to_f64();
        }
        let text = self.published.to_string();
        if text.contains('/') {
            return 0.0;
        }
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((&text, "0"));
        let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        0.5 * 10f64.powi(exponent.parse::<i32>().unwrap_or(0) - decimals as i32)
    }
}

const KEYS: &[&str] = &["quantity", "time", "side", "contact", "origin", "published", "within", "source", "body"];

impl<'a> Reader<'a> {
    /// Returns the published values of the scene, each with its body, from 0; `materials` says of which bodies stress and
    /// force have a value.
    pub(super) fn targets(&self, materials: &[bool]) -> Result<Vec<(usize, Target)>, SceneError> {
        let Some((_, value)) = self.get("target") else { return Ok(Vec::new()) };
        let Some(array) = value.get_ref().as_array() else {
            return Err(self.wrong_type(value, "target", "tables, [[target]]"));
        };
        let table = |value: &'a Value<'a>| match value.get_ref().as_table() {
            Some(document) => Reader { document, ..*self }.target(value.span(), materials),
            None => Err(self.wrong_type(value, "target", "a table, [[target]]")),
        };
        array.into_iter().map(table).collect()
    }

    /// Returns the body of this target, from 0.
    fn body_of_target(&self, bodies: usize, span: Range<usize>) -> Result<usize, SceneError> {
        let expected = format!("the number of a body, from 1, the lowest, to {bodies}");
        let value = match self.get("body") {
            None if bodies == 1 => return Ok(0),
            None => return Err(self.error(span, Kind::Missing, "no body in [[target]]", expected)),
            Some((_, value)) => value,
        };
        let whole = value.get_ref().as_integer().and_then(|whole| whole.as_str().parse::<usize>().ok());
        let place = whole.filter(|body| (1..=bodies).contains(body));
        place.map(|body| body - 1).ok_or_else(|| self.wrong_type(value, "body", &expected))
    }

    /// Returns the published value of this table, which stands at `span`.
    fn target(&self, span: Range<usize>, materials: &[bool]) -> Result<(usize, Target), SceneError> {
        // The last key, `body`, belongs to chains of several bodies.
        let known = &KEYS[..KEYS.len() - usize::from(materials.len() == 1)];
        let near = |key: &str| nearest(key, known.iter().copied()).map(String::from);
        self.check_known((self.document, "[[target]]"), known, near)?;
        let body = self.body_of_target(materials.len(), span.clone())?;
        let has_material = materials[body];
        let missing = |key: &str, expected: &str| {
            self.error(span.clone(), Kind::Missing, format!("no {key} in [[target]]"), expected)
        };
        // What belongs to a contact, and what has a value at every time, but for times and the impulse, whose name is
        // that of a contact's.
        let measured =
            |quantity: &Quantity| !matches!(quantity.measure(), None | Some(Measure::Time | Measure::Impulse));
        let publishable = Needs::Contact.quantities().chain(Needs::Time.quantities().filter(measured));
        let (quantities, names): (Vec<Quantity>, Vec<&str>) = publishable.map(|it| (it, it.name())).unzip();
        let place = self.choice("quantity", &names)?.ok_or_else(|| missing("quantity", &names.join(", ")))?;
        let quantity = quantities[place];
        let refuse = |key: &str, expected: &str| match self.get(key) {
            None => Ok(()),
            Some((key, _)) => {
                let found = format!("{} of the {} in [[target]]", key.get_ref(), quantity.name());
                Err(self.error(key.span(), Kind::Contradiction, found, expected))
            }
        };
        let time = self.plain_number("time")?;
        let (side, origin) = (self.choice("side", &["left", "right"])?, self.choice("origin", &["ground", "start"])?);
        let contact = match self.get("contact") {
            None => 1,
            Some((_, value)) => {
                let whole = value.get_ref().as_integer().and_then(|whole| whole.as_str().parse::<usize>().ok());
                let expected = "the number of a contact, from 1 on";
                whole.filter(|n| *n > 0).ok_or_else(|| self.wrong_type(value, "contact", expected))?
            }
        };
        if quantity.needs() == Needs::Contact {
            refuse("time", "no time: it belongs to a contact")?;
            refuse("side", "no side: it belongs to a contact")?;
        } else {
            refuse("contact", "a time: it has a value at every time")?;
            if time.is_none() {
                return Err(missing("time", &format!("the time of the {}", quantity.name())));
            }
        }
        if !quantity.has_origin() {
            refuse("origin", "an origin of u_end, u_top or h only")?;
        }
        if !quantity.is_listed(has_material) {
            let found = format!("the {} in [[target]]", quantity.name());
            let expected = "modulus and density in [rod], or strain";
            return Err(self.error(span, Kind::Missing, found, expected));
        }
        let target = Target {
            quantity,
            time,
            side: if side == Some(0) { Side::Left } else { Side::Right },
            contact,
            from_start: origin == Some(1),
            published: self.plain_number("published")?.ok_or_else(|| missing("published", "the published value"))?,
            within: self.plain_number("within")?,
            source: self.text("source")?.ok_or_else(|| missing("source", "where it was published"))?.0.to_string(),
        };
        Ok((body, target))
    }
}
