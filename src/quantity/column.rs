//! The named columns of a table over time: what contact codes are compared in.

use super::unit::{Measure, Units};
use crate::error::Error;
use crate::motion::{Ending, EventKind, Motion, Side, StressPiece};
use crate::number::{Open, Scalar};

/// A question to a history; it may answer several columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Source {
    Time,
    Side,
    End,
    Strain,
    Top,
    Contact,
    Centre,
    Energy,
    Parts,
    Impulse,
}

/// What a ray leaves in a quantity where it passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rays {
    /// A jump.
    Jump,
    /// A jump of its rate.
    Kink,
    /// Neither.
    Smooth,
}

/// Where along the rod a quantity is.
#[cfg(feature = "compare")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// At the ground, or nowhere: what jumps there jumps in it.
    Ground,
    /// At the ground, as a switch: contact begins and ends without a jump of the stress too.
    Switch,
    /// At the upper end.
    Top,
    /// At points along the rod.
    Point,
}

/// All that is known of a column.
struct Facts {
    name: &'static str,
    symbol: &'static str,
    meaning: &'static str,
    measure: Option<Measure>,
    /// Where it comes from, and which of the answers there it is.
    source: (Source, usize),
    rays: Rays,
}

/// The columns in the order of a table, with all that is known of each: its name, symbol, meaning, measure, source and
/// what rays leave in it.
macro_rules! columns {
    ($(#[$of_all:meta])* pub enum Column { $($(#[$doc:meta])* $column:ident: $name:literal, $symbol:literal,
        $meaning:literal, $measure:expr, $source:ident $answer:literal, $rays:ident;)+ }) => {
        $(#[$of_all])*
        pub enum Column {
            $($(#[$doc])* $column,)+
        }

        impl Column {
            /// All columns, in the order of a table.
            pub const ALL: [Column; [$(Column::$column),+].len()] = [$(Column::$column),+];

            const fn facts(self) -> Facts {
                match self {
                    $(Column::$column => Facts {
                        name: $name,
                        symbol: $symbol,
                        meaning: $meaning,
                        measure: $measure,
                        source: (Source::$source, $answer),
                        rays: Rays::$rays,
                    },)+
                }
            }
        }
    };
}

columns! {
    /// A quantity of the rod as a function of time, by name.
    ///
    /// Displacements are measured from the undeformed rod that stands on the ground, upwards. Strains and stresses are
    /// positive in tension, the contact force is positive in compression.
    ///
    /// **Units**: with a material (`modulus`, `density`, `area`) stresses, forces, impulses and energies are those of
    /// the rod; without one they are divided by `ρ` (stress, then `c² v_x`) or `ρS` (all others): see [`Column::unit`].
    ///
    /// ```
    /// use dalembert::{Column, Problem, Side};
    /// let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).build()?;
    /// let history = rod.solve()?;
    /// // In the first contact v_x(0,t) = −(μ + g t)/c: at t = 1 the force is 4, and ∫(3 + s)ds = 7/2 was given.
    /// let values = history.columns(&[Column::Force, Column::Impulse], &[1.0], Some(Side::Right))?;
    /// assert_eq!(values, [[4.0], [3.5]]);
    /// // At the impact v_t(0,t) jumps from −μ to 0: two rows.
    /// let values = history.columns(&[Column::Side, Column::EndVelocity], &[0.0, 1.0], None)?;
    /// assert_eq!(values, [[-1.0, 1.0, 0.0], [-3.0, 0.0, 0.0]]);
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Column {
        /// `t`.
        Time: "t", "t", "time",
            Some(Measure::Time), Time 0, Kink;
        /// Which limit the row holds: −1 from earlier times, 1 from later ones, 0 where both are the same.
        Side: "side", "", "which limit at a jump: from earlier times, from later ones, or both the same",
            None, Side 0, Kink;
        /// `v(0,t)`.
        EndDisplacement: "u_end", "v(0,t)", "displacement of the end at the ground, upwards: its gap",
            Some(Measure::Length), End 0, Kink;
        /// `v_t(0,t)`.
        EndVelocity: "v_end", "v_t(0,t)", "velocity of the end at the ground, upwards",
            Some(Measure::Velocity), End 1, Jump;
        /// `v_x(0,t)`.
        Strain: "strain", "v_x(0,t)", "strain at the ground, positive in tension",
            Some(Measure::Strain), Strain 0, Jump;
        /// `E v_x(0,t)`; `c² v_x(0,t)` without a material.
        Stress: "stress", "E v_x(0,t)", "stress at the ground, positive in tension",
            Some(Measure::Stress), Strain 0, Jump;
        /// `−E S v_x(0,t)`: what the ground pushes with, and never less than zero from `t = 0⁺` on.
        Force: "force", "−E S v_x(0,t)", "contact force, positive in compression",
            Some(Measure::Force), Strain 0, Jump;
        /// `v(L,t)`.
        TopDisplacement: "u_top", "v(L,t)", "displacement of the upper end",
            Some(Measure::Length), Top 0, Kink;
        /// `v_t(L,t)`.
        TopVelocity: "v_top", "v_t(L,t)", "velocity of the upper end",
            Some(Measure::Velocity), Top 1, Jump;
        /// `h(t) = (1/L) ∫ v dx`: the centre of mass.
        Centre: "h", "h", "centre of mass above its place in the undeformed rod on the ground",
            Some(Measure::Length), Centre 0, Smooth;
        /// `h′(t)`.
        CentreVelocity: "h_rate", "h′", "velocity of the centre of mass",
            Some(Measure::Velocity), Centre 1, Kink;
        /// `E = E_h + E_z`, (3.54).
        Energy: "E_total", "E", "energy: E_h + E_z, or kinetic + strain_energy + gravity",
            Some(Measure::Energy), Energy 0, Smooth;
        /// `E_h = ρS (L h′²/2 + L g h)`.
        TranslationalEnergy: "E_h", "E_h", "energy of the centre of mass: ρSL(h′²/2 + g h)",
            Some(Measure::Energy), Energy 1, Kink;
        /// `E_z = ½ ρS ∫ ((v_t − h′)² + c² v_x²) dx`.
        VibrationalEnergy: "E_z", "E_z", "energy of the vibration: ½ρS∫((v_t − h′)² + c²v_x²)dx",
            Some(Measure::Energy), Energy 2, Kink;
        /// `½ ρS ∫ v_t² dx`.
        KineticEnergy: "kinetic", "½ρS∫v_t²dx", "kinetic energy",
            Some(Measure::Energy), Parts 0, Kink;
        /// `½ ρS c² ∫ v_x² dx`.
        StrainEnergy: "strain_energy", "½ES∫v_x²dx", "strain energy",
            Some(Measure::Energy), Parts 1, Kink;
        /// `ρS g L h`: zero where the centre of mass is where it is in the undeformed rod on the ground. Kinetic,
        /// strain and gravity energy add up to `E`.
        GravityEnergy: "gravity", "ρSLg h", "energy in gravity, zero at h = 0",
            Some(Measure::Energy), Centre 0, Smooth;
        /// 1 while the end is on the ground, 0 in flight.
        Contact: "contact", "", "1 on the ground, 0 in flight",
            None, Contact 0, Jump;
        /// `∫₀ᵗ force ds`: the momentum that the ground has given since `t = 0`.
        Impulse: "impulse", "∫force dt", "impulse of the contact force since t = 0",
            Some(Measure::Impulse), Impulse 0, Kink;
    }
}

impl Source {
    fn has_sides(self) -> bool {
        matches!(self, Source::End | Source::Strain | Source::Top | Source::Contact)
    }
}

impl Column {
    /// The name in files: `u_end`.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// The column of this name.
    ///
    /// ```
    /// use dalembert::Column;
    /// assert!(Column::ALL.into_iter().all(|column| Column::named(column.name()) == Some(column)));
    /// assert_eq!(Column::named("u"), None);
    /// ```
    pub fn named(name: &str) -> Option<Column> {
        Column::ALL.into_iter().find(|column| column.name() == name)
    }

    /// The symbol: `v(0,t)`; empty where there is none.
    pub fn symbol(self) -> &'static str {
        self.facts().symbol
    }

    /// What it is, in a line.
    pub fn meaning(self) -> &'static str {
        self.facts().meaning
    }

    /// What its values measure; `None` for [`Column::Side`] and [`Column::Contact`].
    pub fn measure(self) -> Option<Measure> {
        self.facts().measure
    }

    /// The unit: `Pa` with a material, `per ρ` without one; empty where there is none or none is known.
    ///
    /// ```
    /// use dalembert::{Column, Problem, UnitSystem, Units};
    /// let bare = Problem::builder().length(1).wave_speed(1).impact_speed(3).build()?;
    /// assert_eq!(Column::Force.unit(&Units::of(&bare, UnitSystem::Si)), "per ρS");
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn unit(self, units: &Units) -> &'static str {
        match self.measure() {
            Some(Measure::Stress) if !units.has_material() => "per ρ",
            Some(Measure::Force) if !units.has_material() => "per ρS",
            Some(measure) => units.name(measure),
            None => "",
        }
    }

    fn source(self) -> (Source, usize) {
        self.facts().source
    }

    /// What a ray leaves in it.
    pub fn rays(self) -> Rays {
        self.facts().rays
    }

    /// Where along the rod it is.
    #[cfg(feature = "compare")]
    pub(crate) fn place(self) -> Place {
        match self.source().0 {
            Source::Top => Place::Top,
            Source::Contact => Place::Switch,
            _ => Place::Ground,
        }
    }

    /// What the answer is multiplied with; `None` where it is the value itself.
    fn factor<S: Scalar>(self, motion: &dyn Motion<S>, units: &Units) -> Option<S> {
        let scales = motion.scales();
        let square = scales.wave_speed.square();
        let factor = |measure| units.factor(measure, &square.precision());
        match self.measure()? {
            Measure::Stress => factor(Measure::Stress).or(Some(square)),
            Measure::Force => factor(Measure::Force).or(Some(-square)),
            Measure::Energy if self == Column::GravityEnergy => {
                factor(Measure::Energy).map(|mass| mass * &scales.gravity * &scales.length)
            }
            measure @ (Measure::Energy | Measure::Impulse) if units.has_material() => factor(measure),
            _ => None,
        }
    }
}

/// The values of `columns` at every time of `times`, column by column. Where `side` is `None` and the two limits of any
/// of them differ, a time has two rows, the limit from earlier times first.
///
/// **Accuracy**: that of the history's answers, and one rounding for each factor.
///
/// **Errors**: what the history cannot answer.
pub fn columns<S: Scalar>(
    motion: &dyn Motion<S>,
    units: &Units,
    columns: &[Column],
    times: &[S],
    side: Option<Side>,
) -> Result<Vec<Vec<S>>, Error> {
    let places: Vec<(Source, usize)> = columns.iter().map(|column| column.source()).collect();
    let factors: Vec<Option<S>> = columns.iter().map(|column| column.factor(motion, units)).collect();
    let mut sources: Vec<Source> = places.iter().map(|(source, _)| *source).collect();
    sources.sort_unstable();
    sources.dedup();
    // Those with two limits are asked first, and their answers stand first in a row.
    let (sided, plain): (Vec<Source>, Vec<Source>) = sources.into_iter().partition(|source| source.has_sides());
    let pushes = if plain.contains(&Source::Impulse) { Some(Pushes::of(motion)) } else { None };
    let asked = || sided.iter().chain(&plain);
    let count = asked().map(|source| source.answers()).sum();
    let start = |of: Source| asked().take_while(|source| **source != of).map(|source| source.answers()).sum::<usize>();
    let places: Vec<usize> = places.iter().map(|(source, index)| start(*source) + index).collect();
    side_by_side(times, |times| {
        let mut table: Vec<Vec<S>> = columns.iter().map(|_| Vec::with_capacity(times.len())).collect();
        let (mut left, mut right) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for time in times {
            let ask = |sources: &[Source], side: Side, limit: i64, row: &mut Vec<S>| {
                for source in sources {
                    match (source, &pushes) {
                        (Source::Side, _) => row.push(time.int(limit)),
                        (Source::Impulse, Some(pushes)) => row.push(pushes.at(time)?),
                        (source, _) => source.ask(motion, time, side, row)?,
                    }
                }
                Ok::<(), Error>(())
            };
            left.clear();
            right.clear();
            let asked = side.unwrap_or_default();
            ask(&sided, asked, 0, &mut right)?;
            if side.is_none() && !sided.is_empty() && motion.may_jump(time)? {
                ask(&sided, Side::Left, 0, &mut left)?;
            }
            let jumps = !left.is_empty() && !left.iter().zip(&right).all(|(a, b)| same(a, b));
            let limit = match side {
                Some(Side::Left) => -1,
                None if !jumps => 0,
                _ => 1,
            };
            ask(&plain, asked, limit, &mut right)?;
            if jumps {
                ask(&plain, Side::Left, -1, &mut left)?;
            }
            for row in [&left, &right].into_iter().skip(usize::from(!jumps)) {
                for ((values, place), factor) in table.iter_mut().zip(&places).zip(&factors) {
                    let value = row[*place].clone();
                    values.push(match factor {
                        Some(factor) => value * factor,
                        None => value,
                    });
                }
            }
        }
        Ok(table)
    })
}

/// Times that a thread is worth.
const WORTH: usize = 2048;

/// The tables of parts of `times`, in one: as many parts as there are cores.
fn side_by_side<S: Scalar>(
    times: &[S],
    rows: impl Fn(&[S]) -> Result<Vec<Vec<S>>, Error> + Sync,
) -> Result<Vec<Vec<S>>, Error> {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let size = times.len().div_ceil(cores).max(WORTH);
    if times.len() <= size {
        return rows(times);
    }
    let rows = &rows;
    let tables = std::thread::scope(|scope| {
        let parts: Vec<_> = times.chunks(size).map(|part| scope.spawn(move || rows(part))).collect();
        let join = |part: std::thread::ScopedJoinHandle<'_, _>| {
            part.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        parts.into_iter().map(join).collect::<Vec<_>>()
    });
    let mut tables = tables.into_iter();
    let mut all = tables.next().unwrap_or_else(|| rows(&[]))?;
    for table in tables {
        all.iter_mut().zip(table?).for_each(|(column, values)| column.extend(values));
    }
    Ok(all)
}

/// The natural scale of each column; `None` where its values are no measurements.
pub(crate) fn natural_scales<S: Scalar>(motion: &dyn Motion<S>, units: &Units, columns: &[Column]) -> Vec<Option<f64>> {
    let scales = motion.scales().map(|scale| scale.to_f64());
    let natural = |column: &Column| {
        let natural = match column.source() {
            (Source::Time | Source::Side | Source::Contact, _) => return None,
            (Source::End | Source::Top | Source::Centre, 0) => scales.velocity * scales.time,
            (Source::End | Source::Top | Source::Centre, _) => scales.velocity,
            (Source::Strain, _) => scales.velocity / scales.wave_speed,
            (Source::Energy | Source::Parts, _) => scales.velocity * scales.velocity * scales.length,
            (Source::Impulse, _) => scales.velocity * scales.length,
        };
        Some(natural * column.factor(motion, units).map_or(1.0, |factor| factor.to_f64().abs()))
    };
    columns.iter().map(natural).collect()
}

/// The values of a table, each column brought to about 1 by a power of two, so that one accuracy holds for columns of
/// different size: 1 is its natural scale, or its greatest value where that is more.
pub(crate) fn of_one_size<S: Scalar>(table: &[Vec<S>], natural: &[Option<f64>]) -> Vec<S> {
    let mut all = Vec::with_capacity(table.len() * table.first().map_or(0, Vec::len) + 1);
    // Zeros are held to the natural scale.
    all.extend(table.iter().find_map(|values| values.first()).map(S::one));
    for (values, natural) in table.iter().zip(natural) {
        let (Some(natural), Some(first)) = (natural, values.first()) else { continue };
        let greatest = values.iter().map(|value| value.to_f64().abs()).fold(*natural, f64::max);
        let unit = first.double((-greatest.log2().round()).clamp(-1000.0, 1000.0).exp2());
        all.extend(values.iter().map(|value| value.clone() * &unit));
    }
    all
}

/// Whether two limits are surely the same. Two enclosures that were computed alike are, although their difference
/// does not show it.
pub(super) fn same<S: Scalar>(a: &S, b: &S) -> bool {
    a.compare(b).is_ok_and(std::cmp::Ordering::is_eq) || (a.ends(0).is_some() && a.text() == b.text())
}

impl Source {
    /// How many numbers it gives.
    fn answers(self) -> usize {
        match self {
            Source::Energy => 3,
            Source::End | Source::Top | Source::Centre | Source::Parts => 2,
            Source::Time | Source::Side | Source::Strain | Source::Contact | Source::Impulse => 1,
        }
    }

    /// Its answers, added to the row.
    fn ask<S: Scalar>(self, motion: &dyn Motion<S>, time: &S, side: Side, row: &mut Vec<S>) -> Result<(), Error> {
        let pair = |(a, b): (S, S)| [a, b];
        match self {
            Source::Time => row.push(time.clone()),
            Source::End => row.extend(pair(motion.ground_end(time, side)?)),
            Source::Strain => row.push(motion.strain(time, side)?),
            Source::Top => row.extend(pair(motion.top_end(time, side)?)),
            Source::Contact => row.push(time.int(in_contact(motion, time, side)?.into())),
            Source::Centre => row.extend(pair(motion.centre(time)?)),
            Source::Energy => {
                let energy = motion.energy(time)?;
                row.extend([energy.total, energy.translational, energy.vibrational]);
            }
            Source::Parts => row.extend(motion.energy_parts(time)?),
            Source::Side | Source::Impulse => (),
        }
        Ok(())
    }
}

/// The first of `list` for which `passed` no longer holds, by bisection.
fn partition<T>(list: &[T], passed: impl Fn(&T) -> Result<bool, Open>) -> Result<usize, Open> {
    let (mut from, mut to) = (0, list.len());
    while from < to {
        let middle = (from + to) / 2;
        if passed(&list[middle])? { from = middle + 1 } else { to = middle }
    }
    Ok(from)
}

/// Whether the end is on the ground just before or just after a time.
fn in_contact<S: Scalar>(motion: &dyn Motion<S>, time: &S, side: Side) -> Result<bool, Open> {
    // The impact that ends a history is no event of it.
    if side == Side::Right && *motion.ending() == Ending::NextImpact && !time.below(&motion.end())? {
        return Ok(true);
    }
    let passed = partition(motion.events(), |event| match side {
        Side::Left => event.time.below(time),
        Side::Right => Ok(!time.below(&event.time)?),
    })?;
    Ok(passed.checked_sub(1).is_some_and(|last| motion.events()[last].kind == EventKind::Impact))
}

/// `−c² ∫₀ᵗ v_x(0,s) ds`: pieces of the stress, each with what came before it.
struct Pushes<S> {
    pieces: Vec<(StressPiece<S>, S)>,
    stiffness: S,
}

impl<S: Scalar> Pushes<S> {
    fn of(motion: &dyn Motion<S>) -> Self {
        let stiffness = -motion.scales().wave_speed.square();
        let mut sum = stiffness.zero();
        let with_sum = |piece: StressPiece<S>| {
            let before = sum.clone();
            sum = sum.clone() + piece.integral(&piece.to);
            (piece, before)
        };
        Pushes { pieces: motion.stress_pieces().into_iter().map(with_sum).collect(), stiffness }
    }

    fn at(&self, time: &S) -> Result<S, Open> {
        let begun = partition(&self.pieces, |(piece, _)| Ok(!time.below(&piece.from)?))?;
        Ok(match begun.checked_sub(1).map(|last| &self.pieces[last]) {
            Some((piece, before)) => (piece.integral(time) + before) * &self.stiffness,
            None => time.zero(),
        })
    }
}
