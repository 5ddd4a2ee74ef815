//! Values that others have published for a scene: data beside it, in `[[target]]`.

use std::ops::Range;

use super::error::SceneError;
use super::reader::Reader;
use crate::chain::{Chain, ChainQuery};
use crate::motion::Side;
use crate::names::{did_you_mean, nearest};
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
    /// The published value.
    pub published: Published,
}

/// A value that others have published for a node of a chain.
///
/// **Units**: those of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainTarget {
    /// The quantity that was published.
    pub quantity: ChainQuery,
    /// The name of the quantity: `force.1`, `release.top`.
    pub name: String,
    /// `t`, for a quantity over time.
    pub time: Option<Number>,
    /// The limit, where there are two.
    pub side: Side,
    /// The number of the contact of the node, from 1, for a quantity of a contact.
    pub contact: usize,
    /// The published value.
    pub published: Published,
}

/// A published number, with its source and what is known of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Published {
    /// The number, with the digits that were published.
    pub value: Number,
    /// Tolerance of the number; without it, half a unit of its last digit, or nothing for a fraction.
    pub within: Option<Number>,
    /// The publication.
    pub source: String,
    /// A remark on the number.
    pub note: Option<String>,
    /// Whether the number is known to be off by more than its tolerance: `expected = "differs"`.
    pub differs: bool,
}

impl Target {
    /// Returns the quantity in words: `u_top from the start`, `release 2`.
    pub fn label(&self) -> String {
        let origin = if self.from_start { " from the start" } else { "" };
        label(self.quantity.name(), self.contact, self.side) + origin
    }
}

impl ChainTarget {
    /// Returns the quantity in words: `release.1 2`, `force.1 from the left`.
    pub fn label(&self) -> String {
        label(&self.name, self.contact, self.side)
    }
}

fn label(name: &str, contact: usize, side: Side) -> String {
    let contact = if contact > 1 { format!(" {contact}") } else { String::new() };
    format!("{name}{contact}{}", if side == Side::Left { " from the left" } else { "" })
}

impl Published {
    /// Returns the tolerance of the number: the one that is given, or half a unit of its last digit; zero for a
    /// fraction.
    ///
    /// ```
    /// use dalembert::Scene;
    /// let scene = "[rod]\nlength = 1\nwave_speed = 3\n[impact]\nspeed = 1\n\
    ///              [[target]]\nquantity = 'release'\npublished = 6.67e-1\nsource = 'by hand'\n";
    /// assert!((Scene::parse(scene)?.targets[0].published.tolerance() - 0.0005).abs() < 1e-15);
    /// # Ok::<(), dalembert::SceneError>(())
    /// ```
    pub fn tolerance(&self) -> f64 {
        if let Some(within) = &self.within {
            return within.to_f64();
        }
        let text = self.value.to_string();
        if text.contains('/') {
            return 0.0;
        }
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((&text, "0"));
        let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
        0.5 * 10f64.powi(exponent.parse::<i32>().unwrap_or(0) - decimals as i32)
    }
}

const KEYS: &[&str] =
    &["quantity", "time", "side", "contact", "origin", "published", "within", "source", "note", "expected", "body"];

/// Published values: those of bodies, each with its body, from 0, and those of the nodes of a chain.
pub(super) type Targets = (Vec<(usize, Target)>, Vec<ChainTarget>);

impl<'a> Reader<'a> {
    /// Returns the published values of the scene, and of `chain` if it is one; `materials` says of which bodies stress
    /// and force have a value.
    pub(super) fn targets(&self, materials: &[bool], chain: Option<&Chain>) -> Result<Targets, SceneError> {
        let mut targets = Targets::default();
        let Some((_, value)) = self.get("target") else { return Ok(targets) };
        let Some(array) = value.get_ref().as_array() else {
            return Err(self.wrong_type(value, "target", "tables, [[target]]"));
        };
        for value in array {
            let Some(document) = value.get_ref().as_table() else {
                return Err(self.wrong_type(value, "target", "a table, [[target]]"));
            };
            let reader = Reader { document, ..*self };
            match (chain, reader.text("quantity")?) {
                (Some(chain), Some((name, span))) if name.contains('.') => {
                    targets.1.push(reader.chain_target((name, span), value.span(), chain)?);
                }
                _ => {
                    let target = reader.target(value.span(), materials)?;
                    if chain.is_some_and(|chain| chain.bodies()[target.0].rigid_mass().is_some()) {
                        let found = format!("the {} of a rigid mass in [[target]]", target.1.quantity);
                        let expected = format!("a quantity with its place: u_end.{}", target.0 + 1);
                        return Err(self.error(value.span(), Kind::Contradiction, found, expected));
                    }
                    targets.0.push(target);
                }
            }
        }
        Ok(targets)
    }

    fn published(&self, span: &Range<usize>) -> Result<Published, SceneError> {
        let missing = |key: &str, expected: &str| {
            self.error(span.clone(), Kind::Missing, format!("no {key} in [[target]]"), expected)
        };
        Ok(Published {
            value: self.plain_number("published")?.ok_or_else(|| missing("published", "the published value"))?,
            within: self.plain_number("within")?,
            source: self.text("source")?.ok_or_else(|| missing("source", "where it was published"))?.0.to_string(),
            note: self.text("note")?.map(|(note, _)| note.to_string()),
            differs: self.choice("expected", &["agrees", "differs"])? == Some(1),
        })
    }

    fn contact_of_target(&self) -> Result<usize, SceneError> {
        let Some((_, value)) = self.get("contact") else { return Ok(1) };
        let whole = value.get_ref().as_integer().and_then(|whole| whole.as_str().parse::<usize>().ok());
        whole.filter(|n| *n > 0).ok_or_else(|| self.wrong_type(value, "contact", "the number of a contact, from 1 on"))
    }

    /// Refuses a key of this table that the quantity `name` does not have.
    fn refuse_in_target(&self, key: &str, name: &str, expected: &str) -> Result<(), SceneError> {
        let Some((key, _)) = self.get(key) else { return Ok(()) };
        let found = format!("{} of the {name} in [[target]]", key.get_ref());
        Err(self.error(key.span(), Kind::Contradiction, found, expected))
    }

    /// Returns the published value of a node or body of `chain`, whose quantity stands at `named`.
    fn chain_target(
        &self,
        (name, named): (&str, Range<usize>),
        span: Range<usize>,
        chain: &Chain,
    ) -> Result<ChainTarget, SceneError> {
        let known: Vec<&str> = KEYS.iter().copied().filter(|key| !["origin", "body"].contains(key)).collect();
        self.check_near((self.document, "[[target]]"), &known)?;
        let Some(quantity) = ChainQuery::read(name, chain) else {
            let names = ChainQuery::names(chain);
            let hint = did_you_mean(nearest(name, names.iter().map(String::as_str)));
            let found = format!("quantity = \"{name}\"");
            return Err(self.error(named, Kind::OutOfRange, found, format!("one of {}{hint}", names.join(", "))));
        };
        let time = self.plain_number("time")?;
        match quantity {
            ChainQuery::Contact(..) => {
                self.refuse_in_target("time", name, "no time: it belongs to a contact")?;
                self.refuse_in_target("side", name, "no side: it belongs to a contact")?;
            }
            ChainQuery::Column(_) => {
                self.refuse_in_target("contact", name, "a time: it has a value at every time")?;
                if time.is_none() {
                    let found = "no time in [[target]]";
                    return Err(self.error(span, Kind::Missing, found, format!("the time of {name}")));
                }
            }
        }
        let side = if self.choice("side", &["left", "right"])? == Some(0) { Side::Left } else { Side::Right };
        let (contact, published) = (self.contact_of_target()?, self.published(&span)?);
        Ok(ChainTarget { quantity, name: name.to_string(), time, side, contact, published })
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
        self.check_near((self.document, "[[target]]"), known)?;
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
        let refuse = |key: &str, expected: &str| self.refuse_in_target(key, quantity.name(), expected);
        let time = self.plain_number("time")?;
        let (side, origin) = (self.choice("side", &["left", "right"])?, self.choice("origin", &["ground", "start"])?);
        let contact = self.contact_of_target()?;
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
            published: self.published(&span)?,
        };
        Ok((body, target))
    }
}
