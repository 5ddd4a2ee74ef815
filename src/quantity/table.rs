//! The table of quantities: all that is known of each. Names, help texts, units, lists and questions follow from it.

use super::unit::{Measure, Units};
use crate::motion::{Motion, Scales};
use crate::number::Scalar;
use Measure::{Energy, Force, Impulse, Length, Strain, Stress, Time, Velocity};

/// A question to a motion; it may answer several quantities.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Source {
    Time,
    /// The limit that a row holds.
    Side,
    End,
    Strain,
    Top,
    Contact,
    Centre,
    Energy,
    Parts,
    /// The impulse of the ground since `t = 0`.
    Impulse,
    /// `x`, and [`Motion::field`].
    Field,
    Event,
    /// [`Motion::contacts`]: beginning, end, length.
    Span,
    /// `v_t(0,t)` just before and just after a contact.
    Ends,
    /// [`Motion::contacts`]: impulse, peak strain.
    Push,
    Restitution,
    Shares,
    /// [`Motion::energy`] at the end of a contact.
    Left,
    Flight,
    Piece,
    /// The first release.
    Bounce,
    /// The last event.
    Last,
    /// The shortest piece of the stress at the ground.
    Shortest,
}

/// The object that a quantity belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    /// A time.
    Time,
    /// A point of the rod and a time.
    PointAndTime,
    /// An impact or a release.
    Event,
    /// A contact.
    Contact,
    /// A flight.
    Flight,
    /// A piece of the stress at the ground.
    Piece,
    /// The first contact alone.
    FirstContact,
    /// The whole run.
    Run,
}

/// All that is known of a quantity.
struct Facts {
    name: &'static str,
    also: &'static [&'static str],
    symbol: &'static str,
    measure: Option<Measure>,
    /// The question that gives it, and its place among the answers.
    source: (Source, usize),
    meaning: &'static str,
}

/// The other names that are understood, if any.
macro_rules! other_names {
    () => {
        &[]
    };
    ($names:tt) => {
        &$names
    };
}

macro_rules! quantities {
    ($($quantity:ident: $name:literal $(also $also:tt)?, $symbol:literal, $measure:expr,
        $source:ident $answer:literal, $meaning:literal;)+) => {
        /// A quantity of a motion, by name. The table holds every one that is printed, asked for or compared.
        ///
        /// Displacements are measured from the undeformed rod that stands on the ground, upwards. Strains and stresses
        /// are positive in tension, forces are positive in compression.
        ///
        /// **Units**: with a material (`modulus`, `density`, `area`) stresses, forces, impulses and energies are those
        /// of the rod; without one they are divided by `ρ` (stress, then `c² v_x`) or `ρS` (all others): see
        /// [`Quantity::unit`].
        ///
        /// ```
        /// use dalembert::{Problem, Quantity, Side};
        /// let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).build()?;
        /// let history = rod.doubles()?;
        /// // In the first contact v_x(0,t) = −(μ + g t)/c: at t = 1 the force is 4, and ∫(3 + s)ds = 7/2 was given.
        /// let values = history.columns(&[Quantity::Force, Quantity::Impulse], &[1.0], Some(Side::Right))?;
        /// assert_eq!(values, [[4.0], [3.5]]);
        /// // At the impact v_t(0,t) jumps from −μ to 0: two rows.
        /// let values = history.columns(&[Quantity::Side, Quantity::EndVelocity], &[0.0, 1.0], None)?;
        /// assert_eq!(values, [[-1.0, 1.0, 0.0], [-3.0, 0.0, 0.0]]);
        /// # Ok::<(), dalembert::Error>(())
        /// ```
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Quantity {
            $(#[doc = concat!("`", $name, "`: ", $meaning, ".")] $quantity,)+
        }

        impl Quantity {
            /// All quantities, those over time first and in the order of a table.
            pub const ALL: &'static [Quantity] = &[$(Quantity::$quantity),+];

            const fn facts(self) -> Facts {
                match self {
                    $(Quantity::$quantity => Facts {
                        name: $name,
                        also: other_names!($($also)?),
                        symbol: $symbol,
                        measure: $measure,
                        source: (Source::$source, $answer),
                        meaning: $meaning,
                    },)+
                }
            }
        }
    };
}

// Each quantity: its name, the key in lists of its own kind where that is another one, and what else it is called;
// symbol, measure, where it comes from and which of the answers there it is; its meaning.
#[rustfmt::skip]
quantities! {
    // Over time.
    Time: "t" also ["time"], "t", Some(Time), Time 0, "time";
    Side: "side", "", None, Side 0,
        "which limit at a jump: from earlier times, from later ones, or both the same; t is the time of the jump, rounded";
    EndDisplacement: "u_end" also ["u", "displacement", "disp", "gap", "u_y", "uy"], "v(0,t)", Some(Length),
        End 0, "displacement of the end at the ground, upwards: its gap";
    EndVelocity: "v_end" also ["v", "velocity", "vel", "v_y", "vy"], "v_t(0,t)", Some(Velocity), End 1,
        "velocity of the end at the ground, upwards";
    Strain: "strain" also ["eps"], "v_x(0,t)", Some(Strain), Strain 0,
        "strain at the ground, positive in tension";
    Stress: "stress" also ["sigma"], "E v_x(0,t)", Some(Stress), Strain 0, "stress at the ground, positive in tension";
    Force: "force"
        also ["f", "contact_force", "reaction", "reaction_force", "lambda", "f_n", "fn", "normal_force", "rf"],
        "−E S v_x(0,t)", Some(Force), Strain 0, "contact force, positive in compression";
    TopDisplacement: "u_top" also ["top_displacement", "u_tip", "tip_displacement"], "v(L,t)", Some(Length),
        Top 0, "displacement of the upper end";
    TopVelocity: "v_top" also ["top_velocity", "v_tip", "tip_velocity"], "v_t(L,t)", Some(Velocity), Top 1,
        "velocity of the upper end";
    TopForce: "force_top" also ["top_force", "reaction_top"], "−E S v_x(L,t)", Some(Force), Top 2,
        "force at the upper end, positive in compression";
    Centre: "h" also ["centre"], "h", Some(Length), Centre 0,
        "centre of mass above its place in the undeformed rod on the ground";
    CentreVelocity: "h_rate" also ["h'", "h_dot"], "h′", Some(Velocity), Centre 1, "velocity of the centre of mass";
    Energy: "E_total" also ["E", "energy", "total", "total_energy", "etot"], "E", Some(Energy), Energy 0,
        "energy: E_h + E_z, or kinetic + strain_energy + gravity";
    TranslationalEnergy: "E_h", "E_h", Some(Energy), Energy 1,
        "energy of the centre of mass: ρSL(h′²/2 + g h)";
    VibrationalEnergy: "E_z" also ["vibrational"], "E_z", Some(Energy), Energy 2,
        "energy of the vibration: ½ρS∫((v_t − h′)² + c²v_x²)dx";
    KineticEnergy: "kinetic" also ["kinetic_energy", "elke"], "½ρS∫v_t²dx", Some(Energy), Parts 0, "kinetic energy";
    StrainEnergy: "strain_energy" also ["internal_energy", "else"], "½ES∫v_x²dx", Some(Energy), Parts 1,
        "strain energy";
    GravityEnergy: "gravity", "ρSLg h", Some(Energy), Centre 0, "energy in gravity, zero at h = 0";
    Contact: "contact", "", None, Contact 0, "1 on the ground, 0 in flight";
    Impulse: "impulse", "∫force dt", Some(Impulse), Impulse 0, "impulse of the contact force since t = 0";

    // Along the rod.
    Point: "x", "x", Some(Length), Field 0, "place along the rod, from the end at the ground";
    PointDisplacement: "u" also ["u_end"], "v", Some(Length), Field 1, "displacement, upwards";
    PointVelocity: "v" also ["v_end"], "v_t", Some(Velocity), Field 2, "velocity, upwards";
    PointStrain: "strain" also ["eps"], "v_x", Some(Strain), Field 3, "strain, positive in tension";
    PointStress: "stress" also ["sigma"], "E v_x", Some(Stress), Field 3, "stress, positive in tension";

    // Of an event.
    EventTime: "t", "t", Some(Time), Event 0, "time of an impact or a release";
    EventVelocity: "v_end", "v_t(0,t)", Some(Velocity), Event 1,
        "velocity of the end, just before an impact, just after a release";
    EventCentre: "h", "h", Some(Length), Event 2, "centre of mass at an impact or a release";
    EventCentreVelocity: "h_rate", "h′", Some(Velocity), Event 3, "its velocity then";

    // Of a contact.
    Impact: "impact", "contact from", Some(Time), Span 0, "time at which a contact begins";
    Release: "release", "to", Some(Time), Span 1, "time at which a contact ends";
    Duration: "duration", "", Some(Time), Span 2, "how long a contact lasts";
    ImpactVelocity: "impact_velocity", "v_t(0,t⁻)", Some(Velocity), Ends 0, "velocity of the end just before a contact";
    ReleaseVelocity: "release_velocity", "v_t(0,t⁺)", Some(Velocity), Ends 1,
        "velocity of the end just after a contact";
    ContactImpulse: "impulse", "impulse", Some(Impulse), Push 0, "impulse of a contact";
    PeakStrain: "peak_strain", "peak v_x(0,t)", Some(Strain), Push 1,
        "the most compressive strain at the ground in a contact";
    PeakStress: "peak_stress", "peak stress", Some(Stress), Push 1,
        "the most compressive stress at the ground in a contact";
    PeakForce: "peak_force", "peak force", Some(Force), Push 1, "the greatest force of the ground in a contact";
    MomentumRestitution: "e_P", "e_P", None, Restitution 0,
        "ratio of the momenta at both ends of a contact";
    EnergyRestitution: "e_E2" also ["restitution"], "e_E²", None, Restitution 1,
        "ratio of the energies of the centre of mass at both ends of a contact";
    TranslationalShare: "translational_part", "E_h/E", None, Shares 0,
        "what part of the energy at the end of a contact moves the centre of mass";
    EnergyKept: "energy_kept", "E/E₀", None, Shares 1, "what part of the energy a contact keeps";
    EnergyAfter: "E_total_after", "E", Some(Energy), Left 0, "energy at the end of a contact";
    TranslationalAfter: "E_h_after", "E_h", Some(Energy), Left 1,
        "energy of the centre of mass at the end of a contact";
    VibrationalAfter: "E_z_after", "E_z", Some(Energy), Left 2,
        "energy of the vibration at the end of a contact";

    // Of a flight.
    Takeoff: "takeoff", "flight from", Some(Time), Flight 0, "time at which a flight begins";
    Landing: "landing", "to", Some(Time), Flight 1, "time at which a flight ends";
    TopTime: "top_time", "highest at", Some(Time), Flight 2,
        "when the centre of mass is highest in a flight, if it turns";
    Top: "top", "h_max", Some(Length), Flight 3, "how high the centre of mass comes in a flight, if it turns";

    // Of a piece of the stress at the ground.
    PieceStart: "start", "start", Some(Time), Piece 0, "where a piece of the stress at the ground begins";
    PieceEnd: "end", "end", Some(Time), Piece 1, "where it ends";
    PieceStrainStart: "strain_start", "v_x(0,start⁺)", Some(Strain), Piece 2, "strain at the ground where it begins";
    PieceStrainEnd: "strain_end", "v_x(0,end⁻)", Some(Strain), Piece 3, "strain at the ground where it ends";
    PieceStressStart: "stress_start", "E v_x(0,start⁺)", Some(Stress), Piece 2, "stress at the ground where it begins";
    PieceStressEnd: "stress_end", "E v_x(0,end⁻)", Some(Stress), Piece 3, "stress at the ground where it ends";

    // Of the first contact, and of the whole run.
    BounceTime: "bounce_time", "t_b", Some(Time), Bounce 0, "time of the first release";
    LastEvent: "last_event", "time of the last event", Some(Time), Last 0,
        "time of the last impact or release of the run";
    ShortestPiece: "shortest_piece", "", Some(Time), Shortest 0,
        "length of the shortest piece of the stress at the ground";
}

impl Source {
    /// Returns whether there are two limits at a jump.
    pub(super) fn has_sides(self) -> bool {
        matches!(self, Source::End | Source::Strain | Source::Top | Source::Contact)
    }

    pub(super) fn answers(self) -> usize {
        match self {
            Source::Energy | Source::Top => 3,
            Source::End | Source::Centre | Source::Parts => 2,
            _ => 1,
        }
    }

    fn needs(self) -> Needs {
        match self {
            Source::Time | Source::Side | Source::End | Source::Strain | Source::Top => Needs::Time,
            Source::Contact | Source::Centre | Source::Energy | Source::Parts | Source::Impulse => Needs::Time,
            Source::Field => Needs::PointAndTime,
            Source::Event => Needs::Event,
            Source::Span | Source::Ends | Source::Push => Needs::Contact,
            Source::Restitution | Source::Shares | Source::Left => Needs::Contact,
            Source::Flight => Needs::Flight,
            Source::Piece => Needs::Piece,
            Source::Bounce => Needs::FirstContact,
            Source::Last | Source::Shortest => Needs::Run,
        }
    }
}

impl Needs {
    /// Returns the quantities that need this, in the order of a table.
    pub fn quantities(self) -> impl Iterator<Item = Quantity> {
        self.all().iter().copied()
    }

    pub(super) fn all(self) -> &'static [Quantity] {
        // The table lists quantities of one kind one after the other.
        let mut kinds = Quantity::ALL.chunk_by(|a, b| a.needs() == b.needs());
        kinds.find(|kind| kind[0].needs() == self).unwrap_or_default()
    }

    /// Returns the quantity of this name among them.
    ///
    /// ```
    /// use dalembert::{Quantity, quantity::Needs};
    /// assert_eq!(Needs::Time.named("impulse"), Some(Quantity::Impulse));
    /// assert_eq!(Needs::Contact.named("impulse"), Some(Quantity::ContactImpulse));
    /// assert_eq!(Needs::Time.named("u"), None);
    /// ```
    pub fn named(self, name: &str) -> Option<Quantity> {
        self.quantities().find(|quantity| quantity.name() == name)
    }

    /// Returns the quantity of this name among them, or of this other name that is understood.
    pub fn called(self, name: &str) -> Option<Quantity> {
        self.named(name).or_else(|| self.quantities().find(|quantity| quantity.also().contains(&name)))
    }
}

impl Quantity {
    /// Returns the name: `u_end`. No other quantity that needs the same has it.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// Returns other names that are understood.
    pub fn also(self) -> &'static [&'static str] {
        self.facts().also
    }

    /// Returns the symbol: `v(0,t)`; empty where there is none.
    pub fn symbol(self) -> &'static str {
        self.facts().symbol
    }

    /// Returns its meaning, in a line.
    pub fn meaning(self) -> &'static str {
        self.facts().meaning
    }

    /// Returns the measure of its values; `None` for ratios, and for [`Quantity::Side`] and [`Quantity::Contact`].
    pub fn measure(self) -> Option<Measure> {
        self.facts().measure
    }

    /// Returns the object that it belongs to.
    pub fn needs(self) -> Needs {
        self.source().0.needs()
    }

    /// Returns whether its value depends on the history before the time.
    pub fn is_of_past(self) -> bool {
        matches!(self, Quantity::Contact | Quantity::Impulse)
    }

    /// Returns whether it follows from the values at both ends of a contact.
    pub(crate) fn is_of_ends(self) -> bool {
        matches!(self.source().0, Source::Span | Source::Restitution | Source::Shares | Source::Left)
    }

    /// Returns whether it jumps where a ray passes, or contact begins or ends.
    pub fn jumps(self) -> bool {
        match self.source() {
            (Source::Strain | Source::Contact, _) => true,
            (Source::End | Source::Top, answer) => answer > 0,
            (Source::Field, answer) => answer > 1,
            _ => false,
        }
    }

    /// Returns whether it is counted from where the undeformed rod stands on the ground, as displacements are.
    pub fn has_origin(self) -> bool {
        self.measure() == Some(Length)
    }

    /// Returns whether lists have it: stresses and forces are listed with a material only.
    pub fn is_listed(self, has_material: bool) -> bool {
        has_material || !matches!(self.measure(), Some(Stress | Force))
    }

    /// Returns the unit: `Pa` with a material, `per ρ` without one; empty where there is none or none is known.
    ///
    /// ```
    /// use dalembert::{Problem, Quantity, Units, quantity::UnitSystem};
    /// let bare = Problem::builder().length(1).wave_speed(1).impact_speed(3).build()?;
    /// assert_eq!(Quantity::Force.unit(&Units::new(&bare, UnitSystem::Si)), "per ρS");
    /// # Ok::<(), dalembert::Error>(())
    /// ```
    pub fn unit(self, units: &Units) -> &'static str {
        match self.measure() {
            Some(Stress) if !units.has_material() => "per ρ",
            Some(Force) if !units.has_material() => "per ρS",
            Some(measure) => units.name(measure),
            None => "",
        }
    }

    pub(super) fn source(self) -> (Source, usize) {
        self.facts().source
    }

    /// Returns the factor from the answer to the value; `None` where it is the value itself.
    pub fn factor<S: Scalar>(self, scales: &Scales<S>, units: &Units) -> Option<S> {
        let square = scales.wave_speed.square();
        let factor = |measure| units.factor(measure, &square.precision());
        match self.measure()? {
            Stress => factor(Stress).or(Some(square)),
            Force => factor(Force).or(Some(-square)),
            Energy if self == Quantity::GravityEnergy => {
                factor(Energy).map(|mass| mass * &scales.gravity * &scales.length)
            }
            measure @ (Energy | Impulse) if units.has_material() => factor(measure),
            _ => None,
        }
    }

    /// Returns an answer of the motion in the unit of the quantity.
    pub fn in_unit<S: Scalar>(self, value: S, scales: &Scales<S>, units: &Units) -> S {
        match self.factor(scales, units) {
            Some(factor) => value * factor,
            None => value,
        }
    }

    /// Returns the natural scale; `None` where its values are no measurements.
    pub(crate) fn natural_scale<S: Scalar>(self, motion: &dyn Motion<S>, units: &Units) -> Option<f64> {
        let scales = motion.scales().map(|scale| scale.to_f64());
        let natural = match self.measure()? {
            Time => return None,
            Length if self == Quantity::Point => return None,
            Energy if self == Quantity::GravityEnergy => scales.velocity * scales.time,
            Length => scales.velocity * scales.time,
            Velocity => scales.velocity,
            Strain | Stress | Force => scales.velocity / scales.wave_speed,
            Energy => scales.velocity * scales.velocity * scales.length,
            Impulse => scales.velocity * scales.length,
        };
        Some(natural * self.factor(&motion.scales(), units).map_or(1.0, |factor| factor.to_f64().abs()))
    }
}
