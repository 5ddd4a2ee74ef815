//! What a history says against a longer one, and against balances that no engine knows.

use std::fmt::Debug;

use super::Counts;
use super::account::{Account, BITS, Known, exact, float, sum};
use dalembert::quantity::Needs;
use dalembert::{EventKind, Float, Material, Number, Problem, Quantity, Side, Top};

/// `found` against what a longer run says.
pub(super) fn compare(name: &str, found: &Account, truth: &Account, counts: &mut Counts) -> Vec<String> {
    let mut wrong = Vec::new();
    let warned = found.warned() || truth.warned();
    let mut check = |what: &dyn Debug, found: &Known, truth: &Known| {
        counts.compared += 1;
        if let Some(off) = found.off(truth) {
            wrong.push(format!(
                "{name}: {what:?}: {} ± {:e}, expected {} ± {:e}, off by {off:e}",
                found.0.to_f64(),
                found.1,
                truth.0.to_f64(),
                truth.1
            ));
        }
    };
    let kinds = |account: &Account| account.events.iter().map(|event| event.0).collect::<Vec<_>>();
    let (ours, theirs) = (kinds(found), kinds(truth));
    let known = ours.len().min(theirs.len());
    let alike = ours[..known] == theirs[..known];
    if alike && !warned {
        for (k, (a, b)) in found.events.iter().zip(&truth.events).enumerate() {
            for (j, (x, y)) in a.1.iter().zip(&b.1).enumerate() {
                check(&("event", k, j), x, y);
            }
            check(&("time_error", k), &Known(a.1[0].0.clone(), a.2), &Known(b.1[0].0.clone(), b.2));
        }
        if found.ending == truth.ending || ours.len() == theirs.len() {
            // What a contact that lasts has given is counted up to the end of its own run.
            let ended = |account: &Account| account.events.iter().filter(|e| e.0 == EventKind::Release).count();
            let ended = ended(found).min(ended(truth));
            for ((name, a), (_, b)) in found.tables.iter().zip(&truth.tables) {
                let of_contact = ["impulse", "peak_strain", "peak_stress", "peak_force"].contains(name);
                for (k, pair) in a.iter().zip(b).enumerate().take(if of_contact { ended } else { usize::MAX }) {
                    if let (Some(a), Some(b)) = pair {
                        check(&(name, k), a, b);
                    }
                }
            }
        }
    }
    for (a, b) in found.at.iter().zip(&truth.at) {
        let place = (a.time.to_string(), a.side);
        for ((quantity, x), y) in Needs::Time.quantities().zip(&a.columns).zip(&b.columns) {
            check(&(quantity, &place), x, y);
        }
        for (k, (x, y)) in a.fields.iter().zip(&b.fields).enumerate() {
            (0..3).for_each(|j| check(&("field", k, j, &place), &x[j], &y[j]));
        }
        for (k, (x, y)) in a.means.iter().zip(&b.means).enumerate() {
            (0..3).for_each(|j| check(&("mean", k, j, &place), &x[j], &y[j]));
        }
    }
    if !warned {
        if !alike || (found.ending == truth.ending && ours.len() != theirs.len()) {
            wrong.push(format!("{name}: events {:?}\nexpected {:?}", found.events, truth.events));
        }
        for ((table, a), (_, b)) in found.tables.iter().zip(&truth.tables) {
            let known = |list: &[Option<Known>]| list.iter().map(Option::is_some).collect::<Vec<_>>();
            if found.ending == truth.ending && known(a) != known(b) {
                wrong.push(format!("{name}: {table}: {a:?}\nexpected {b:?}"));
            }
        }
    }
    wrong
}

/// What holds between the numbers of one run: balances, and the conditions at both ends.
pub(super) fn balances(
    name: &str,
    (problem, points): (&Problem, &[Number]),
    account: &Account,
    counts: &mut Counts,
) -> Vec<String> {
    use Quantity::{
        Centre, CentreVelocity, Contact, EndDisplacement, EndVelocity, Energy, Force, GravityEnergy, Impulse,
        KineticEnergy, Strain, StrainEnergy, TopDisplacement, TopVelocity, TranslationalEnergy, VibrationalEnergy,
    };
    let mut wrong = Vec::new();
    let length = Known::of(problem.length());
    let [damping, gravity] =
        [problem.damping(), problem.gravity()].map(|x| x.map_or(Known(float(0.0), 0.0), Known::of));
    let known = |x: f64| Known(float(x), 0.0);
    let (one, minus) = (known(1.0), known(-1.0));
    // ρS, which turns values per ρS into those of the material.
    let line = match problem.material() {
        Material::WaveSpeed(_) => known(1.0),
        Material::Elastic { density, area, .. } => {
            let area = area.as_ref().map_or(float(1.0), exact);
            Known(exact(density) * area, 0.0)
        }
    };
    let free = problem.top() == Top::Free;
    let mut zero = |what: String, (found, size): (Known, f64)| {
        counts.balanced += 1;
        if !found.vanishes(size * 1e-140) {
            wrong.push(format!("{name}: {what} is off by {:e} ± {:e} of {size:e}", found.0.to_f64(), found.1));
        }
    };
    let product = |a: &Known, b: &Known| sum(&[(a, b)]).0;
    for k in 0..account.at.len() {
        let (at, value) = (&account.at[k], |quantity| account.column(k, quantity));
        let what = |text: &str| format!("{text} at {} {:?}", at.time, at.side);
        zero(
            what("E = kinetic + strain + gravity"),
            sum(&[
                (&one, value(KineticEnergy)),
                (&one, value(StrainEnergy)),
                (&one, value(GravityEnergy)),
                (&minus, value(Energy)),
            ]),
        );
        let parts = [(&one, value(TranslationalEnergy)), (&one, value(VibrationalEnergy)), (&minus, value(Energy))];
        zero(what("E = E_h + E_z"), sum(&parts));
        // E_h = ρSL (h′²/2 + g h).
        let (mass, rate) = (product(&line, &length), value(CentreVelocity));
        let (half, weight) = (product(&product(&mass, rate), &known(0.5)), product(&mass, &gravity));
        let parts = [(&half, rate), (&weight, value(Centre)), (&minus, value(TranslationalEnergy))];
        zero(what("E_h"), sum(&parts));
        if free {
            // ρS (L (h′ + 2r h + g t) − what it was) = ∫ force.
            let (twice, time) = (product(&mass, &product(&damping, &known(2.0))), Known::of(&at.time));
            let minus_mass = product(&mass, &minus);
            let parts = [
                (&mass, rate),
                (&twice, value(Centre)),
                (&weight, &time),
                (&minus_mass, account.column(0, CentreVelocity)),
                (&product(&twice, &minus), account.column(0, Centre)),
                (&minus, value(Impulse)),
            ];
            zero(what("momentum"), sum(&parts));
        }
        let (ground, top) = (&at.fields[0], at.fields.get(2));
        let mut pairs = vec![
            ("v(0,t)", [&ground[0], value(EndDisplacement)]),
            ("v_t(0,t)", [&ground[1], value(EndVelocity)]),
            ("v_x(0,t)", [&ground[2], value(Strain)]),
        ];
        if let Some(top) = top {
            pairs.push(("v(L,t)", [&top[0], value(TopDisplacement)]));
            pairs.push(("v_t(L,t)", [&top[1], value(TopVelocity)]));
        }
        for (what_of, pair) in pairs {
            zero(what(what_of), sum(&[(&one, pair[0]), (&minus, pair[1])]));
        }
        if at.time.is_zero() && at.side == Side::Left {
            continue;
        }
        let held = if free { top.map(|top| &top[2]) } else { Some(value(TopVelocity)) };
        held.into_iter().for_each(|held| zero(what("the condition at the top"), (held.clone(), 0.0)));
        let contact = value(Contact);
        if contact.1 == 0.0 {
            let on = contact.0 == 1;
            let pair = if on { [value(EndDisplacement), value(EndVelocity)] } else { [value(Strain), value(Force)] };
            for value in pair {
                zero(what("the condition at the ground"), (value.clone(), 0.0));
            }
            let sign = if on { value(Strain).0.to_f64() } else { -value(EndDisplacement).0.to_f64() };
            let bound = if on { value(Strain).1 } else { value(EndDisplacement).1 };
            zero(what("the sign at the ground"), (Known(float(sign.max(0.0)), bound), 0.0));
        }
        // v from point to point, and the mean of the whole rod.
        let (mut rise, mut area, mut momentum) = (Vec::new(), Vec::new(), Vec::new());
        let widths: Vec<Known> = points
            .windows(2)
            .map(|pair| Known(Float::with_val(BITS, exact(&pair[1]) - exact(&pair[0])), 0.0))
            .collect();
        for ((width, mean), ends) in widths.iter().zip(&at.means).zip(at.fields.windows(2)) {
            let change = sum(&[(&one, &ends[1][0]), (&minus, &ends[0][0])]).0;
            rise.push(sum(&[(width, &mean[2]), (&minus, &change)]));
            area.push((width, &mean[0]));
            momentum.push((width, &mean[1]));
        }
        rise.into_iter().for_each(|rise| zero(what("∫ v_x dx"), rise));
        if top.is_some() {
            let minus_length = product(&minus, &length);
            area.push((&minus_length, value(Centre)));
            momentum.push((&minus_length, rate));
            zero(what("∫ v dx"), sum(&area));
            zero(what("∫ v_t dx"), sum(&momentum));
        }
    }
    // In the order of time: the energy never grows, and without damping it stays.
    for k in (2..account.at.len()).step_by(2) {
        let (before, after) = (account.column(k - 2, Energy), account.column(k, Energy));
        let (mut change, size) = sum(&[(&one, after), (&minus, before)]);
        if problem.damping().is_some() {
            change.0 = change.0.max(&float(0.0));
        }
        zero(format!("the energy's change up to {}", account.at[k].time), (change, size));
    }
    wrong
}
