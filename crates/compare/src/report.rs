//! The report of a comparison, as a table and as JSON.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::agreement::{Agreement, Coverage};
use super::audit::Extreme;
use super::comparison::{ComparedFile, Comparison, FittedFile};
use super::contacts::ContactPair;
use super::diagnosis::Diagnosis;
use super::fit::FittedValue;
use super::hint::{Detectable, Hint};
use super::limit::Order;
use super::norms::{ComparedColumn, NORMS, Norm, WEIGHTS};
use super::softness::SoftColumn;
use crate::aligned::table;
use dalembert::number::Scalar;
use dalembert::quantity::{Quantity, Units};

/// The units of norms over time.
const NORM_UNITS: &str = "the unit is that of L∞; L1 is in this unit times time, L2 in this unit times √time\n";

/// The meaning of the words of the table.
pub const LEGEND: &str = "\
norm                L1 = ∫|e| dt, L2 = √∫e² dt, L∞ = max |e| of e = theirs − ours, by the
                    trapezoidal rule; relative to the same norm of ours
off jumps           over samples further from a jump of ours than the window: 0.02 round trips or two
                    steps, whichever is more, where nothing else is said
sample on a jump    compared with the nearer of the two limits, or the one that its row names
impulse             ∫ F dt over the contact
centroid            ∫ t F dt / ∫ F dt: the mean time of the force
peak force          the greatest F
gaps closed         separations within a contact shorter than a quarter of the round trip, and of
                    our shortest flight: the contact chatters, and they count as part of it
penetration         the deepest the end is below the ground
tension in contact  the greatest pull of the ground
∫|v F| dt           gap times force, zero where contact and gap exclude each other; in units of
                    energy times time, such as J s
energy              how much more the energy of theirs has changed than that of ours
momentum            what is left of P′ + 2rP = F − weight over all samples, P the momentum
missed, invented    contacts of ours without one of theirs, and the other way round
below the step      such contacts that are shorter than two steps: samples need not show them
not covered         times of the run without samples
hint                one number that explains most of what differs in all that it concerns, up to the
                    second impact, with its standard error; where several explain it about equally
                    well, all of them, and none is asserted
no hint             no such number; spread: the width of a ramp that is as far from a jump as theirs
one would be told   the sizes from which on a wrong number stands out of what differs, and is found
                    within a fifth
";

fn number(x: f64) -> String {
    x.decimal(6)
}

/// Returns `peak force, N`.
fn with_unit(name: &str, what: Quantity, units: &Units) -> String {
    match what.unit(units) {
        "" => name.to_string(),
        unit => format!("{name}, {unit}"),
    }
}

/// Returns `1 gap` or `2 gaps`.
fn counted(count: usize, one: &str) -> String {
    format!("{count} {one}{}", if count == 1 { "" } else { "s" })
}

/// Returns `12.34`, `1.234e-5`, or `–`.
fn size(x: Option<f64>) -> String {
    match x {
        None => "–".into(),
        Some(0.0) => "0".into(),
        Some(x) if (1e-3..1e5).contains(&x.abs()) => x.decimal(4),
        Some(x) => format!("{x:.3e}"),
    }
}

/// Returns `0.12 %`, or `–`.
fn share(x: Option<f64>) -> String {
    match x {
        None => "–".into(),
        Some(0.0) => "0".into(),
        Some(x) if x < 1e-6 => format!("{x:.1e}"),
        Some(x) => format!("{} %", (100.0 * x).decimal(3)),
    }
}

fn file_table(compared: &ComparedFile, title: Option<&str>, units: &Units) -> String {
    let ComparedFile { file, agreement, softness, diagnosis, fit } = compared;
    let times = &agreement.grid.times;
    let (first, last) = (times.first().copied().unwrap_or(0.0), times.last().copied().unwrap_or(0.0));
    let mut out = title.map_or_else(String::new, |title| format!("{title}\n"));
    let (count, step) = (times.len(), number(agreement.step));
    out += &format!("{file}: {count} samples from t = {} to {}, step {step}\n", number(first), number(last));
    let Coverage { time: [_, end], contacts: [contacts, of], breaks_off } = agreement.coverage;
    let share = (100.0 * agreement.coverage.share()).decimal(4);
    let broken = if breaks_off { ": THE RUN BREAKS OFF, unless a time to go to says so" } else { "" };
    out += &format!("covers {share} % of the run to t = {}, {contacts} of {of} contacts{broken}\n", number(end));
    agreement.notes.iter().for_each(|note| out += &format!("{note}\n"));
    if agreement.outside > 0 {
        out += &format!("{} rows before t = 0 are not compared\n", agreement.outside);
    }
    let norm_units = if agreement.grid.points.is_none() { NORM_UNITS } else { "" };
    out += &format!("theirs − ours; norms are {WEIGHTS}\n{norm_units}\n{}\n", norms_table(agreement, units));
    if !softness.is_empty() {
        out += &format!("\n{}\n", softness_table(softness));
    }
    if !agreement.contacts.is_empty() {
        out += &format!("\n{}\n", contacts_table(&agreement.contacts, units));
    }
    if agreement.grid.points.is_none() {
        out += &format!("\n{}", audit_lines(agreement, units));
    }
    out.push('\n');
    out += &hint_lines(diagnosis);
    if diagnosis.hints.is_empty() {
        let theirs = agreement.contacts.iter().filter_map(|pair| pair.theirs.as_ref());
        let merged = theirs.map(|contact| contact.merged);
        let chatter: Vec<usize> = merged.filter(|merged| *merged > 0).collect();
        out += "no hint: no single wrong number that was tried explains what differs";
        if !chatter.is_empty() {
            let (gaps, contacts) = (counted(chatter.iter().sum(), "gap"), counted(chatter.len(), "contact"));
            out += &format!("; the contact chatters: {gaps} closed in {contacts}");
        } else if let Some(width) = diagnosis.spread {
            let steps = width / agreement.step;
            out += &format!("; the fronts are spread over {} ({steps:.1} steps), as by dispersion", width.decimal(3));
        }
        out.push('\n');
        out += &detectable_line(&diagnosis.detectable);
    }
    if let Some(fit) = fit {
        out += &format!("\n{}\n", fit_table(fit, agreement));
    }
    out
}

/// Returns the table of the parts of the difference from rigid contact.
fn softness_table(columns: &[SoftColumn]) -> String {
    let cell = |norm: &Norm| match norm.relative {
        Some(relative) => format!("{} ({})", size(Some(norm.absolute)), share(Some(relative))),
        None => size(Some(norm.absolute)),
    };
    let row = |column: &SoftColumn| {
        let SoftColumn { name, from_rigid, contact, scheme } = column;
        vec![(*name).into(), cell(from_rigid), cell(contact), cell(scheme)]
    };
    let header = ["L2 of", "theirs − rigid", "their contact: soft − rigid", "their scheme: theirs − soft"];
    format!("ours yields as their contact does\n{}", table(&header, columns.iter().map(row).collect(), 1))
}

/// Returns the hints, those that explain the data about equally well below each other.
fn hint_lines(diagnosis: &Diagnosis) -> String {
    let rivals = diagnosis.hints.iter().filter(|hint| !hint.asserted).count();
    let mut heading = (rivals > 0).then(|| {
        let count = if rivals == 2 { "two".to_string() } else { rivals.to_string() };
        format!("hint: {count} causes explain the data about equally well:\n")
    });
    let line = |hint: &Hint| match hint.asserted {
        true => format!("hint: {}\n", hint.text),
        false => heading.take().unwrap_or_default() + &format!("      {}\n", hint.text),
    };
    diagnosis.hints.iter().map(line).collect()
}

/// Returns the line with the least sizes of wrong numbers that concern all columns.
fn detectable_line(detectable: &[Detectable]) -> String {
    let one = |told: &Detectable| match told.kind {
        kind @ ("time_shift" | "damping") => format!("{kind} {}", told.value.decimal(2)),
        kind => format!("{kind} {} %", (100.0 * told.value).decimal(2)),
    };
    let all: Vec<String> = detectable.iter().filter(|told| told.quantity == "all").map(one).collect();
    if all.is_empty() { String::new() } else { format!("one would be told from: {}\n", all.join(", ")) }
}

/// Correlation of neighbouring residuals above which they are no noise.
const ALIKE: f64 = 0.5;

/// The note on a fit whose residuals are no noise.
const SHIFTED: &str = "\nneighbouring residuals are alike, as those of a scheme: its error shifts the values too, and the\n\
    standard errors, from the scatter of the residuals, do not contain that; a finer mesh shows it";

/// Returns the tables of a fit: the values, the misfit of each column, and the contacts.
fn fit_table(FittedFile { fit, agreement: then, .. }: &FittedFile, now: &Agreement) -> String {
    let row = |value: &FittedValue| {
        vec![value.name.clone(), value.scene.decimal(10), value.value.decimal(10), format!("{:.1e}", value.error)]
    };
    let values = table(&["fitted", "scene", "value", "standard error"], fit.values.iter().map(row).collect(), 1);
    let column = |(now, then): (&ComparedColumn, &ComparedColumn)| {
        let of = |norm: Norm| norm.relative.map_or_else(|| size(Some(norm.absolute)), |relative| share(Some(relative)));
        vec![now.what.name().into(), of(now.norms.l2), of(then.norms.l2)]
    };
    let columns = now.quantities.iter().zip(&then.quantities).map(column).collect();
    let columns = table(&["L2 of", "scene", "fitted"], columns, 1);
    let contact = |(k, ContactPair { ours, theirs }): (usize, &ContactPair)| {
        let texts = match (ours, theirs) {
            (Some(a), Some(b)) => a.differences(b)[..4].iter().map(|x| size(*x)).collect(),
            _ => vec!["unpaired".into()],
        };
        [vec![(k + 1).to_string()], texts].concat()
    };
    let contacts: Vec<_> = then.contacts.iter().enumerate().map(contact).collect();
    let contacts = match contacts.is_empty() {
        true => String::new(),
        false => {
            format!("\n\n{}", table(&["theirs − fitted", "impact", "release", "impulse", "centroid"], contacts, 1))
        }
    };
    let end = if fit.settled { "" } else { "; it had not settled" };
    let is_scheme = fit.correlation.is_some_and(|correlation| correlation > ALIKE);
    let note = if is_scheme { SHIFTED } else { "" };
    format!("{values}{note}\nin {}{end}\n\n{columns}{contacts}", counted(fit.steps, "step"))
}

fn norms_table(agreement: &Agreement, units: &Units) -> String {
    let mut rows = Vec::new();
    for ComparedColumn { what, norms, .. } in &agreement.quantities {
        let name = with_unit(what.name(), *what, units);
        let on_jumps = match norms.on_jumps {
            0 => String::new(),
            1 => "1 sample on a jump".to_string(),
            count => format!("{count} samples on jumps"),
        };
        let names = [name, on_jumps, String::new(), String::new()];
        let shown = if what.jumps() { 4 } else { 3 };
        for (name, kind) in names.into_iter().zip(NORMS).take(shown) {
            let norm = (kind.get)(norms);
            let point = norm.and_then(|norm| norm.x).map_or_else(String::new, |x| format!(", x = {}", number(x)));
            let at = norm.and_then(|norm| norm.t).map_or_else(String::new, |time| number(time) + &point);
            let absolute = size(norm.map(|norm| norm.absolute));
            rows.push(vec![name, kind.title.into(), absolute, share(norm.and_then(|norm| norm.relative)), at]);
        }
    }
    table(&["quantity", "norm", "absolute", "relative", "at t"], rows, 2)
}

fn contacts_table(contacts: &[ContactPair], units: &Units) -> String {
    let row = |name: &str, whose: String, values: [Option<f64>; 5]| {
        let numbers = values.map(|value| value.map_or_else(|| "–".into(), number));
        [&[name.to_string(), whose][..], &numbers].concat()
    };
    let mut rows = Vec::new();
    for (k, ContactPair { ours, theirs }) in contacts.iter().enumerate() {
        let name = &(k + 1).to_string();
        let whose = match theirs.as_ref().map_or(0, |contact| contact.merged) {
            0 => "theirs".to_string(),
            count => format!("theirs, {} closed", counted(count, "gap")),
        };
        match (ours, theirs) {
            (Some(a), Some(b)) => {
                rows.push(row(name, "ours".into(), a.numbers()));
                rows.push(row("", whose, b.numbers()));
                rows.push(row("", "difference".into(), a.differences(b)));
            }
            (Some(a), None) => {
                let why = if a.below_step { "below their step" } else { "missing in theirs" };
                rows.push(row(name, format!("ours, {why}"), a.numbers()));
            }
            (None, Some(b)) => {
                let why = if b.below_step { "below the step" } else { "not in ours" };
                rows.push(row(name, format!("{whose}, {why}"), b.numbers()));
            }
            (None, None) => {}
        }
    }
    let impulse = with_unit("impulse", Quantity::Impulse, units);
    let peak = with_unit("peak force", Quantity::Force, units);
    table(&["contact", "", "impact", "release", &impulse, "centroid", &peak], rows, 2)
}

fn audit_lines(agreement: &Agreement, units: &Units) -> String {
    let audit = &agreement.audit;
    let with = |value: f64, unit: &str| format!("{} {unit}", size(Some(value))).trim_end().to_string();
    let at = |extreme: &Extreme, unit: &str| match extreme.value {
        0.0 => "none".to_string(),
        value => format!("{} at t = {}", with(value, unit), number(extreme.time)),
    };
    let or = |text: Option<String>, needs: &str| text.unwrap_or_else(|| format!("– (needs {needs})"));
    let [length, force, impulse, joule] =
        [Quantity::EndDisplacement, Quantity::Force, Quantity::Impulse, Quantity::Energy]
            .map(|column| column.unit(units));
    // Energy times time; per ρS without a material.
    let action = if units.has_material() && !joule.is_empty() { format!("{joule} s") } else { joule.to_string() };
    let energy = audit.energy_change.as_ref().map(|energy| {
        let of_ours =
            energy.relative.map_or_else(String::new, |share| format!(" ({} of ours)", self::share(Some(share.abs()))));
        let way = if energy.change < 0.0 { "lost" } else { "gained" };
        let change = with(energy.change.abs(), joule);
        let (gain, loss) = (at(&energy.gain, joule), at(&energy.loss, joule));
        format!("{change} {way} in all{of_ours}\n{:20}most gained: {gain}; most lost: {loss}", "")
    });
    let covered: Vec<String> =
        audit.not_covered.iter().map(|[from, to]| format!("t = {} … {}", number(*from), number(*to))).collect();
    let below = if audit.below_step > 0 { format!(", {} below the step", audit.below_step) } else { String::new() };
    let momentum = audit.momentum.map(|x| format!("{} out of balance", with(x, impulse)));
    let of_ours = audit.indentation.as_ref().map(|x| format!("; ours: {}", at(x, length))).unwrap_or_default();
    let penetration = audit.penetration.as_ref().map(|x| at(x, length) + &of_ours);
    let lines = [
        ("penetration", or(penetration, "u_end")),
        ("tension in contact", or(audit.tension.as_ref().map(|x| at(x, force)), "force, stress or strain")),
        ("∫|v F| dt", or(audit.complementarity.map(|x| with(x, &action)), "u_end and force")),
        ("energy", or(energy, "E_total")),
        ("momentum", or(momentum, "force, h_rate and a free top")),
        ("contacts", format!("{} missed, {} invented{below}", audit.missed, audit.invented)),
        ("not covered", if covered.is_empty() { "nothing".into() } else { covered.join(", ") }),
    ];
    let is_soft = audit.indentation.is_some();
    let is_left_out =
        |(name, text): &(&str, String)| text.starts_with('–') && (audit.of_body || is_soft && *name == "∫|v F| dt");
    let left_out = audit
        .of_body
        .then(|| ("not audited", "penetration, energy and momentum: other bodies or ends act on this one".into()));
    let lines = lines.into_iter().filter(|line| !is_left_out(line)).chain(left_out);
    lines.map(|(name, text)| format!("{name:<20}{text}\n")).collect()
}

/// Returns the table of the orders of convergence, one row for each pair of neighbouring files.
fn orders_table(orders: &[Order]) -> String {
    let order = |x: Option<f64>| x.map_or_else(|| "–".into(), |x| format!("{x:.2}"));
    let rows = orders.iter().map(|row| {
        let widths = format!("{} → {}", number(row.widths[0]), number(row.widths[1]));
        let order = |x: Option<f64>| order(x.filter(|_| row.meaningless.is_none()));
        [row.quantity.into(), widths].into_iter().chain(row.orders.values().map(|x| order(*x))).collect()
    });
    let header = [&["observed order", "width"][..], &NORMS.map(|norm| norm.title)].concat();
    let mut out = table(&header, rows.collect(), 2) + "\n";
    for Order { quantity, widths, meaningless, .. } in orders {
        let said =
            |why: &&str| format!("no order of {quantity} from {} to {}: {why}\n", number(widths[0]), number(widths[1]));
        out += &meaningless.as_ref().map(said).unwrap_or_default();
    }
    out
}

/// The version of the form of JSON: 1.
#[derive(Clone, Copy, Debug, Default)]
pub struct SchemaVersion;

impl Serialize for SchemaVersion {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u8(1)
    }
}

impl JsonSchema for SchemaVersion {
    fn schema_name() -> Cow<'static, str> {
        "version".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({"const": 1})
    }
}

/// The report of a comparison with one file.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "comparison")]
pub struct FileReport<'a> {
    schema: SchemaVersion,
    title: Option<&'a str>,
    #[serde(flatten)]
    file: &'a ComparedFile,
}

/// The report of a comparison with data of several bodies of a chain.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "comparisons_of_bodies")]
pub struct BodiesReport<'a> {
    schema: SchemaVersion,
    title: Option<&'a str>,
    /// The bodies with data, from the bottom up.
    bodies: Vec<BodyReport<'a>>,
}

impl<'a> BodiesReport<'a> {
    /// Builds the report of a scene from those of its bodies, from the bottom up.
    pub fn new(title: Option<&'a str>, bodies: Vec<BodyReport<'a>>) -> Self {
        BodiesReport { schema: SchemaVersion, title, bodies }
    }
}

/// The report of a body of a chain.
#[derive(Serialize, JsonSchema)]
pub struct BodyReport<'a> {
    body: usize,
    name: Option<&'a str>,
    files: &'a [ComparedFile],
    /// The observed order of convergence between each file and the next.
    orders: &'a [Order],
}

/// The report of a comparison with several files.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "comparisons")]
pub struct SeriesReport<'a> {
    schema: SchemaVersion,
    title: Option<&'a str>,
    files: &'a [ComparedFile],
    /// The observed order of convergence between each file and the next.
    orders: &'a [Order],
}

impl Comparison {
    /// Returns the report as text.
    pub fn table(&self, title: Option<&str>) -> String {
        let mut tables: Vec<String> = self.files.iter().map(|file| file_table(file, title, &self.units)).collect();
        tables.extend((self.files.len() > 1).then(|| orders_table(&self.orders)));
        tables.join("\n")
    }

    /// Returns the report for the body of a chain with this number, from 1, and name.
    pub fn of_body<'a>(&'a self, body: usize, name: Option<&'a str>) -> BodyReport<'a> {
        BodyReport { body, name, files: &self.files, orders: &self.orders }
    }

    /// Returns the report as JSON, schema 1: the members of a single file stand at the top, those of several under
    /// `files`, with their `orders`.
    pub fn json(&self, title: Option<&str>) -> Value {
        let schema = SchemaVersion;
        match self.files.as_slice() {
            [one] => json!(FileReport { schema, title, file: one }),
            _ => json!(SeriesReport { schema, title, files: &self.files, orders: &self.orders }),
        }
    }
}
