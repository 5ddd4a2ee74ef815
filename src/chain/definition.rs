//! A chain of bodies in exact numbers, checked once.

use super::body::{Body, BodyMaterial, Points};
use crate::error::{Error, ProblemError, ProblemErrorKind as Kind};
use crate::number::{Number, Rational, Scalar, short};

/// Whether chains with springs, dashpots and masses are built in.
pub(super) const SOFT: bool = cfg!(feature = "chain");

/// Limit of the wave pieces of a run, unless the chain states another one.
pub const MAX_PIECES: usize = 2_000_000;

/// Share of the latest time by which a run goes beyond it.
const BEYOND: f64 = 1.0 / 16.0;

/// A spring with a dashpot beside it, through which two neighbours act on each other.
///
/// The compressive force is `k δ + d δ′` for the depth `δ`, which is the negative gap. In a contact it acts while it
/// pushes, and in a bonded joint always.
///
/// **Units**: those of a whole cross-section, `k` in force per length and `d` in force per velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// `k ≥ 0`.
    pub stiffness: Number,
    /// `d ≥ 0`.
    pub damping: Number,
}

/// The connection of a body to the body below it.
#[derive(Clone, Debug, PartialEq)]
pub enum Joint {
    /// Unilateral contact: the bodies push and never pull.
    Contact {
        /// Distance of the two ends at the start, displacements included.
        gap: Number,
    },
    /// Both ends move as one.
    Bonded,
}

/// The condition at the bottom or the top of a [`Chain`].
#[derive(Clone, Debug, PartialEq)]
pub enum End {
    /// No force.
    Free,
    /// An axial force over time; it pulls where it is positive.
    Force(Points),
    /// A velocity over time; zero holds the end.
    Velocity(Points),
    /// A rigid stop in unilateral contact, at a distance and with a velocity over time.
    Ground {
        /// Distance at the start.
        gap: Number,
        /// Velocity over time; empty for a stop at rest.
        velocity: Points,
    },
    /// A half-infinite bar, at rest at the start.
    Infinite {
        /// Impedance of the bar; that of the last body if absent, which absorbs every wave.
        impedance: Option<Number>,
        /// Distance at the start for a bar in unilateral contact; absent for a bonded one.
        gap: Option<Number>,
    },
}

impl End {
    /// Returns the points of a force or a velocity over time.
    pub(super) fn points(&self) -> Option<&Points> {
        match self {
            End::Force(points) | End::Velocity(points) | End::Ground { velocity: points, .. } => Some(points),
            End::Free | End::Infinite { .. } => None,
        }
    }

    /// Returns the impedance of a half-infinite bar, if it has one of its own.
    pub(super) fn impedance(&self) -> Option<&Number> {
        match self {
            End::Infinite { impedance, .. } => impedance.as_ref(),
            _ => None,
        }
    }
}

/// A chain of undamped elastic bars and rigid masses along one axis, from the bottom up.
///
/// ```
/// use dalembert::chain::{Body, Chain, End};
/// let bar = |velocity: i64| Body::new(1.into(), 1.into(), 1.into()).with_velocity(velocity.into());
/// let chain = Chain::builder(bar(0)).contact(1.into(), bar(-1)).until(4.into()).build()?;
/// assert_eq!(chain.bodies().len(), 2);
/// let error = Chain::builder(bar(0)).contact((-1).into(), bar(-1)).until(4.into()).build().unwrap_err();
/// assert_eq!(error.path, "body[1].gap");
/// # Ok::<(), dalembert::problem::ProblemError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    pub(super) bodies: Vec<Body>,
    pub(super) joints: Vec<Joint>,
    pub(super) ends: [End; 2],
    /// The springs, each at its node.
    pub(super) springs: Vec<(usize, Spring)>,
    pub(super) gravity: Number,
    pub(super) until: Number,
    pub(super) max_pieces: usize,
}

/// A chain that is not checked.
#[derive(Clone, Debug)]
pub struct ChainBuilder(Chain);
impl Chain {
    /// Begins a chain with its lowest body; both ends are free until they are given.
    pub fn builder(lowest: Body) -> ChainBuilder {
        let (zero, ends) = (Number::from(0), [End::Free, End::Free]);
        let bodies = vec![lowest];
        ChainBuilder(Chain {
            bodies,
            joints: Vec::new(),
            ends,
            springs: Vec::new(),
            gravity: zero.clone(),
            until: zero,
            max_pieces: MAX_PIECES,
        })
    }

    /// Returns the bodies, from the bottom up.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Returns the connection of each body but the lowest to the body below it.
    pub fn joints(&self) -> &[Joint] {
        &self.joints
    }

    /// Returns the conditions at the bottom and at the top.
    pub fn ends(&self) -> &[End; 2] {
        &self.ends
    }

    /// Returns the spring at a node, if it has one: 0 is the bottom of the chain, `n` lies above the n-th body.
    pub fn spring(&self, node: usize) -> Option<&Spring> {
        self.springs.iter().find(|(at, _)| *at == node).map(|(_, spring)| spring)
    }

    /// Returns whether the chain has a spring or a dashpot.
    pub fn has_springs(&self) -> bool {
        !self.springs.is_empty()
    }

    /// Returns whether the chain has a spring, a dashpot or a rigid mass, so that its signals are curves.
    pub fn is_soft(&self) -> bool {
        self.has_springs() || self.bodies.iter().any(|body| body.rigid_mass().is_some())
    }

    /// Returns the acceleration of gravity, downward.
    pub fn gravity(&self) -> &Number {
        &self.gravity
    }

    /// Returns the last time of the run, which is included.
    pub fn until(&self) -> &Number {
        &self.until
    }

    /// Returns the limit of the wave pieces of a run.
    pub fn max_pieces(&self) -> usize {
        self.max_pieces
    }

    /// Returns the chain with another last time.
    ///
    /// **Errors**: those of [`ChainBuilder::build`].
    pub fn with_until(&self, until: Number) -> Result<Chain, ProblemError> {
        ChainBuilder(Chain { until, ..self.clone() }).build()
    }

    /// Returns the chain with the last time that a run needs to answer up to `latest`: it goes a little beyond, so that
    /// an event at this time is not at the end of the run.
    ///
    /// **Errors**: [`ProblemError`] for a time that is no last time of a run.
    pub fn reaching(&self, latest: &Number) -> Result<Chain, ProblemError> {
        let is_beyond = latest.compare(&self.until).is_gt();
        // A run has a last time above zero.
        let enough = (latest.to_f64() * (1.0 + BEYOND)).max(self.until.to_f64() * f64::EPSILON);
        match enough.to_string().parse::<Number>() {
            Ok(enough) if is_beyond || latest.to_f64() >= 0.0 && enough.compare(&self.until).is_lt() => {
                self.with_until(enough)
            }
            _ if is_beyond => self.with_until(latest.clone()),
            _ => Ok(self.clone()),
        }
    }

    /// Returns the chain with another body in the place of one of its bodies, not checked.
    pub(crate) fn with_body(&self, body: usize, by: Body) -> Chain {
        let mut chain = self.clone();
        chain.bodies[body] = by;
        chain
    }

    /// Refuses the index of a body that there is not.
    pub(crate) fn check_body(&self, body: usize) -> Result<(), Error> {
        let count = self.bodies.len();
        if body < count {
            return Ok(());
        }
        let (found, expected) = (format!("body {} of {count}", body + 1), format!("a body from 1 to {count}"));
        Err(ProblemError::new(Kind::OutOfRange, &format!("body[{body}]"), found, expected).into())
    }

    /// Returns the chain with another gravity, not checked.
    pub(crate) fn with_gravity(self, gravity: Number) -> Chain {
        Chain { gravity, ..self }
    }

    /// Returns the chain with another stiffness of the spring at a node, not checked.
    pub(crate) fn with_stiffness(mut self, node: usize, stiffness: Number) -> Chain {
        self.springs
            .iter_mut()
            .filter(|(at, _)| *at == node)
            .for_each(|(_, spring)| spring.stiffness = stiffness.clone());
        self
    }

    /// Returns the chain with another last time, not checked.
    pub(crate) fn with_end(self, until: Number) -> Chain {
        Chain { until, ..self }
    }

    /// Returns the chain with another limit of its wave pieces.
    pub(crate) fn with_max_pieces(&self, max_pieces: usize) -> Chain {
        Chain { max_pieces, ..self.clone() }
    }

    /// Checks the chain after a change.
    pub(crate) fn checked(self) -> Result<Chain, ProblemError> {
        ChainBuilder(self).build()
    }

    /// Returns the name of a node in messages and output: `joint 1` lies between the bodies 1 and 2.
    pub fn node_name(&self, node: usize) -> String {
        match node {
            0 => "bottom".into(),
            node if node == self.bodies.len() => "top".into(),
            node => format!("joint {node}"),
        }
    }

    /// Returns whether a node is a unilateral contact: 0 is the bottom of the chain, `n` lies above the n-th body.
    pub fn is_contact(&self, node: usize) -> bool {
        self.start_gap(node).is_some()
    }

    /// Returns whether the chain is one bar above a ground at rest, whose displacements count from its contact with the
    /// ground: a rod as on rigid ground, though the ground may yield and the top may have another end.
    ///
    /// ```
    /// use dalembert::chain::{Body, Chain, End};
    /// let bar = || Body::new(1.into(), 1.into(), 1.into()).with_velocity((-1).into());
    /// let chain = |bottom: End| Chain::builder(bar()).bottom(bottom).until(3.into()).build();
    /// assert!(chain(End::Ground { gap: 0.into(), velocity: Vec::new() })?.is_on_ground());
    /// assert!(!chain(End::Ground { gap: 1.into(), velocity: Vec::new() })?.is_on_ground());
    /// assert!(!chain(End::Free)?.is_on_ground());
    /// # Ok::<(), dalembert::problem::ProblemError>(())
    /// ```
    pub fn is_on_ground(&self) -> bool {
        let ([body], [End::Ground { gap, velocity }, _]) = (&self.bodies[..], &self.ends) else { return false };
        let height = body.displacement.first().map_or_else(|| 0.into(), |(_, height)| height.to_rational());
        velocity.is_empty() && height == gap.to_rational()
    }

    /// Returns the gap of a node at the start if it is a unilateral contact.
    pub(super) fn start_gap(&self, node: usize) -> Option<Rational> {
        let top = self.bodies.len();
        let gap = match (node.checked_sub(1), &self.ends) {
            (None, [End::Ground { gap, .. } | End::Infinite { gap: Some(gap), .. }, _]) => gap,
            (_, [_, End::Ground { gap, .. } | End::Infinite { gap: Some(gap), .. }]) if node == top => gap,
            (Some(joint), _) if node < top => match &self.joints[joint] {
                Joint::Contact { gap } => gap,
                Joint::Bonded => return None,
            },
            _ => return None,
        };
        Some(gap.to_rational())
    }
}

impl ChainBuilder {
    /// Adds a body in unilateral contact with the one below it, at this distance.
    pub fn contact(self, gap: Number, body: Body) -> Self {
        self.joined(Joint::Contact { gap }, body)
    }

    /// Adds a body that is bonded to the one below it.
    pub fn bonded(self, body: Body) -> Self {
        self.joined(Joint::Bonded, body)
    }

    pub(crate) fn joined(mut self, joint: Joint, body: Body) -> Self {
        self.0.joints.push(joint);
        self.0.bodies.push(body);
        self
    }

    /// Sets the condition at the bottom.
    pub fn bottom(mut self, end: End) -> Self {
        self.0.ends[0] = end;
        self
    }

    /// Sets the condition at the top.
    pub fn top(mut self, end: End) -> Self {
        self.0.ends[1] = end;
        self
    }

    /// Puts a spring in place of rigid contact, or of a rigid bond, at a node: 0 is the bottom of the chain, `n` lies
    /// above the n-th body.
    ///
    /// ```
    /// use dalembert::chain::{Body, Chain, ChainColumn, End, Spring};
    /// use dalembert::{Number, Numbers, Side};
    /// // A free rod on a penalty of 20 EA/L leaves the ground at 2L/c + x/ω with eˣ = 2 + 2x, for ω = 20 c/L.
    /// let rod = Body::new(1.into(), 1.into(), 1.into()).with_velocity((-1).into());
    /// let spring = Spring { stiffness: 20.into(), damping: 0.into() };
    /// let ground = End::Ground { gap: 0.into(), velocity: Vec::new() };
    /// let chain = Chain::builder(rod).bottom(ground).spring(0, spring).until(3.into()).build()?;
    /// let release = chain.solve(Numbers::Digits(30))?.listing()?.events[1].t.to_string();
    /// assert_eq!(release, "2.08391734950083303260736240307");
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn spring(mut self, node: usize, spring: Spring) -> Self {
        self.0.springs.push((node, spring));
        self
    }

    /// Sets the acceleration of gravity, downward.
    pub fn gravity(mut self, gravity: Number) -> Self {
        self.0.gravity = gravity;
        self
    }

    /// Sets the last time.
    pub fn until(mut self, until: Number) -> Self {
        self.0.until = until;
        self
    }

    /// Sets the limit of the wave pieces of a run.
    pub fn max_pieces(mut self, max_pieces: usize) -> Self {
        self.0.max_pieces = max_pieces;
        self
    }

    /// Checks the chain.
    ///
    /// **Errors**: [`ProblemError`] with the path of the value: `body[1].gap`, `ends.top`, `gravity.acceleration`.
    pub fn build(self) -> Result<Chain, ProblemError> {
        let chain = self.0;
        for (k, body) in chain.bodies.iter().enumerate() {
            let path = |key: &str| format!("body[{k}].{key}");
            if let BodyMaterial::Rigid { mass } = &body.material {
                positive(&path("mass"), "mass", mass)?;
                for (key, points) in body.lists() {
                    if points.len() > usize::from(key == "velocity") {
                        let found = format!("{} points of the {key} of a rigid body", points.len());
                        let expected = "one velocity, and no deformation: a rigid body has no length";
                        return Err(ProblemError::new(Kind::Contradiction, &path(key), found, expected));
                    }
                    for (_, value) in points {
                        within_limits(&path(key), key, &value.to_rational())?;
                    }
                }
                continue;
            }
            positive(&path("length"), "length", &body.length)?;
            match &body.material {
                BodyMaterial::Impedance { wave_speed, impedance } => {
                    positive(&path("wave_speed"), "wave_speed", wave_speed)?;
                    positive(&path("impedance"), "impedance", impedance)?;
                }
                BodyMaterial::Elastic { modulus, density, area } => {
                    positive(&path("modulus"), "modulus", modulus)?;
                    positive(&path("density"), "density", density)?;
                    positive(&path("area"), "area", area)?;
                }
                BodyMaterial::Rigid { .. } => {}
            }
            if !body.displacement.is_empty() && !body.strain.is_empty() {
                return Err(ProblemError::strain_and_displacement(&path("strain")));
            }
            for (key, points) in body.lists() {
                let may_jump = key != "displacement";
                check_points(&path(key), (key, "x"), points, Some(&body.length), may_jump)?;
            }
        }
        for node in 0..=chain.bodies.len() {
            let gap = chain.start_gap(node);
            let path = match node {
                0 => "ends.bottom".to_string(),
                node if node == chain.bodies.len() => "ends.top".to_string(),
                node => format!("body[{node}].gap"),
            };
            let Some(gap) = gap else { continue };
            within_limits(&path, "gap", &gap)?;
            if gap < Rational::default() {
                let found = format!("a gap of {} at the {}", short(&gap.to_string()), chain.node_name(node));
                let expected = "zero or more: bodies do not overlap at the start";
                return Err(ProblemError::new(Kind::OutOfRange, &path, found, expected));
            }
        }
        for (end, name) in chain.ends.iter().zip(["bottom", "top"]) {
            let path = format!("ends.{name}");
            match end {
                End::Force(points) => check_points(&path, ("force", "t"), points, None, true)?,
                End::Velocity(points) => check_points(&path, ("velocity", "t"), points, None, true)?,
                End::Ground { velocity, .. } => check_points(&path, ("velocity", "t"), velocity, None, true)?,
                End::Infinite { impedance: Some(impedance), .. } => positive(&path, "impedance", impedance)?,
                End::Free | End::Infinite { impedance: None, .. } => (),
            }
        }
        chain.check_springs()?;
        within_limits("gravity.acceleration", "acceleration", &chain.gravity.to_rational())?;
        if chain.gravity.to_f64() < 0.0 {
            let found = format!("acceleration = {}", chain.gravity);
            return Err(ProblemError::new(Kind::OutOfRange, "gravity.acceleration", found, "zero or more"));
        }
        positive("run.time", "time", &chain.until)?;
        Ok(chain)
    }
}

impl Chain {
    /// Returns the chain with rigid joints and ends in place of springs and dashpots.
    pub(crate) fn without_springs(&self) -> Result<Chain, ProblemError> {
        Chain { springs: Vec::new(), ..self.clone() }.checked()
    }

    /// Returns the nodes of the contacts without a spring, from the bottom up.
    pub fn rigid_contacts(&self) -> impl Iterator<Item = usize> {
        (0..=self.bodies.len()).filter(|node| self.is_contact(*node) && self.spring(*node).is_none())
    }

    /// Returns the chain with a spring of this stiffness in addition at each of `nodes`.
    pub(crate) fn with_springs(&self, nodes: &[usize], stiffness: &Number) -> Result<Chain, ProblemError> {
        let spring = |node: &usize| (*node, Spring { stiffness: stiffness.clone(), damping: 0.into() });
        let springs = self.springs.iter().cloned().chain(nodes.iter().map(spring)).collect();
        Chain { springs, ..self.clone() }.checked()
    }

    /// Checks the springs, and that neighbours without an elastic side between them have one.
    fn check_springs(&self) -> Result<(), ProblemError> {
        let top = self.bodies.len();
        let path = |node: usize| match node {
            0 => "ends.bottom".to_string(),
            node if node == top => "ends.top".to_string(),
            node => format!("body[{node}].joint"),
        };
        for (k, (node, spring)) in self.springs.iter().enumerate() {
            let refuse = |found: String, expected: &str| {
                Err(ProblemError::new(Kind::Contradiction, &path(*node), found, expected.to_string()))
            };
            let place = if *node > top { format!("node {node}") } else { self.node_name(*node) };
            if *node > top || self.springs[..k].iter().any(|(other, _)| other == node) {
                return refuse(format!("a spring at {place}"), "one spring at a node of the chain");
            }
            for (name, value) in [("stiffness", &spring.stiffness), ("damping", &spring.damping)] {
                let size = value.to_f64();
                if !(value.is_zero() || (LIMITS.0..=LIMITS.1).contains(&size)) {
                    let found = format!("{name} = {}", short(&value.to_string()));
                    let expected = "zero, or a number between 1e-40 and 1e40";
                    let path = format!("{}.{name}", path(*node));
                    return Err(ProblemError::new(Kind::OutOfRange, &path, found, expected));
                }
            }
            if spring.stiffness.is_zero() && spring.damping.is_zero() {
                let found = format!("no stiffness and no damping at {place}");
                let path = format!("{}.stiffness", path(*node));
                return Err(ProblemError::new(Kind::Contradiction, &path, found, "one of them above zero"));
            }
            let end = (*node == 0).then_some(&self.ends[0]).or_else(|| (*node == top).then_some(&self.ends[1]));
            if matches!(end, Some(End::Free | End::Force(_))) {
                return refuse(
                    format!("a spring at the {place}, which is free or loaded"),
                    "ground, or an end that is held",
                );
            }
        }
        for node in 0..=top {
            let is_rigid = |body: Option<usize>| body.is_none_or(|body| self.bodies[body].rigid_mass().is_some());
            let end = (node == 0).then_some(&self.ends[0]).or_else(|| (node == top).then_some(&self.ends[1]));
            let yields = matches!(end, Some(End::Free | End::Force(_) | End::Infinite { .. }));
            let neighbours = [node.checked_sub(1), (node < top).then_some(node)];
            if !yields && neighbours.into_iter().all(is_rigid) && self.spring(node).is_none() {
                let found = format!("a rigid {} beside a rigid mass", self.node_name(node));
                let expected = "a stiffness or a damping there: rigid bodies that meet have no force of finite size";
                return Err(ProblemError::new(Kind::Contradiction, &path(node), found, expected));
            }
        }
        Ok(())
    }
}

/// Limits of the size of every number but zero.
const LIMITS: (f64, f64) = (1e-40, 1e40);

fn positive(path: &str, name: &str, number: &Number) -> Result<(), ProblemError> {
    let value = number.to_f64();
    if value > 0.0 && (LIMITS.0..=LIMITS.1).contains(&value) {
        return Ok(());
    }
    let expected = if value > 0.0 { "a number between 1e-40 and 1e40" } else { "a number above zero" };
    let found = format!("{name} = {}", short(&number.to_string()));
    Err(ProblemError::new(Kind::OutOfRange, path, found, expected))
}

/// Checks a number that may be zero or negative.
fn within_limits(path: &str, name: &str, number: &Rational) -> Result<(), ProblemError> {
    let size = Scalar::to_f64(number).abs();
    if *number == Rational::default() || (LIMITS.0..=LIMITS.1).contains(&size) {
        return Ok(());
    }
    let found = format!("{name} = {}", short(&number.to_string()));
    let expected = "zero, or a number between 1e-40 and 1e40 in size";
    Err(ProblemError::new(Kind::OutOfRange, path, found, expected))
}

/// Checks points in the order of their place: from zero on, up to `end` if it is given, each place at most twice.
fn check_points(
    path: &str,
    (name, place): (&str, &str),
    points: &Points,
    end: Option<&Number>,
    may_jump: bool,
) -> Result<(), ProblemError> {
    let refuse = |k: usize, expected: &str| {
        let found = points.get(k).map_or("no points".into(), |(at, _)| format!("{place} = {at} of the {name}"));
        let path = if k < points.len() { format!("{path}[{k}].{place}") } else { path.to_string() };
        Err(ProblemError::new(Kind::Profile, &path, found, expected.to_string()))
    };
    let Some((first, _)) = points.first() else { return Ok(()) };
    for (k, (_, value)) in points.iter().enumerate() {
        within_limits(&format!("{path}[{k}]"), name, &value.to_rational())?;
    }
    if !first.is_zero() {
        return refuse(0, &format!("the first point at {place} = 0"));
    }
    for (k, pair) in points.windows(2).enumerate() {
        let order = pair[0].0.compare(&pair[1].0);
        let twice = k > 0 && points[k - 1].0.compare(&pair[1].0).is_eq();
        if order.is_gt() {
            return refuse(k + 1, "a place beyond the one before it");
        }
        if order.is_eq() && (!may_jump || twice) {
            return refuse(k + 1, if may_jump { "each place at most twice" } else { "each place once" });
        }
        let at_end = end.is_some_and(|end| pair[1].0.compare(end).is_eq());
        if order.is_eq() && end.is_some() && (pair[1].0.is_zero() || at_end) {
            return refuse(k + 1, "a jump inside the body, not at its end");
        }
    }
    match (points.last(), end) {
        (Some((last, _)), Some(end)) if last.compare(end).is_ne() => {
            refuse(points.len() - 1, &format!("the last point at the length {end}"))
        }
        _ => Ok(()),
    }
}
