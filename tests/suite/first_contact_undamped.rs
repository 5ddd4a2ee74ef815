//! The paper's undamped formulas, against each other and against the balance laws, in fractions.

use crate::common::fraction as q;
use dalembert::number::Scalar;
use dalembert::{Parameters, Rational, Side};
use dalembert_verify::paper::UndampedContact;
use proptest::prelude::*;

fn parameters(l: Rational, c: Rational, g: Rational, mu: Rational) -> Parameters<Rational> {
    Parameters { length: l, wave_speed: c, damping: q(0, 1), gravity: g, speed: mu }
}

/// `∫ f` over `[a,b]`, exact for cubics: Simpson's rule.
fn integral(a: &Rational, b: &Rational, f: impl Fn(&Rational) -> Rational) -> Rational {
    let mid = (a.clone() + b) / q(2, 1);
    (f(a) + f(&mid) * q(4, 1) + f(b)) * (b.clone() - a) / q(6, 1)
}

prop_compose! {
    fn scenes()(l in 1i64..30, c in 1i64..30, g in 1i64..30, mu in 1i64..90, d in 1i64..7)
        -> Parameters<Rational> {
        parameters(q(l, d), q(c, 3), q(g, 5), q(mu, 7))
    }
}

proptest! {
    /// P' = −c² v_x(0,t) − gL (3.36), h' = P/L (3.39), E_h = P²/2L + Lgh (3.63): every printed formula is in one of
    /// them.
    #[test]
    fn printed_formulas_agree(rod in scenes(), part in 1i64..20) {
        let exact = UndampedContact::new(&rod).unwrap();
        let (t1, tb) = (rod.round_trip(), exact.bounce_time());
        let (l, c, g) = (&rod.length, &rod.wave_speed, &rod.gravity);
        let end = tb.clone() + &t1;
        let mut cuts = vec![q(0, 1), t1.clone(), tb.clone(), end];
        cuts.dedup();
        let (mut p, mut h) = (-rod.speed.clone() * l, q(0, 1));
        for cell in cuts.windows(2) {
            // The balance over a part of the cell, and over all of it.
            for fraction in [q(part, 20), q(1, 1)] {
                let to = cell[0].clone() + (cell[1].clone() - &cell[0]) * &fraction;
                let stress = |t: &Rational| {
                    let side = if *t == cell[0] { Side::Right } else { Side::Left };
                    exact.strain(t, side)
                };
                let force = integral(&cell[0], &to, |t| -(c.square() * stress(t)) - g.clone() * l);
                let momentum = integral(&cell[0], &to, |t| exact.momentum(t));
                prop_assert_eq!(exact.momentum(&to), p.clone() + force);
                let (height, velocity) = exact.centre(&to);
                prop_assert_eq!(&height, &(h.clone() + momentum / l));
                prop_assert_eq!(&(velocity * l), &exact.momentum(&to));
                let energy = exact.momentum(&to).square() / (q(2, 1) * l) + l.clone() * g * &height;
                prop_assert_eq!(exact.translational_energy(&to), energy);
            }
            p = exact.momentum(&cell[1]);
            h = exact.centre(&cell[1]).0;
        }
        // The stress is never tensile, and the ground lets go where it vanishes or jumps.
        prop_assert!(exact.strain(&(tb.clone() * q(part, 20)), Side::Left) <= q(0, 1));
        let e_z = exact.total_energy() - exact.translational_energy(&tb);
        prop_assert_eq!(&exact.vibrational_energy_at_bounce(), &e_z);
        let ratio = exact.translational_energy(&tb) / exact.total_energy();
        prop_assert_eq!(exact.energy_restitution_squared(), Some(ratio));
        prop_assert_eq!(exact.momentum_restitution() * &rod.speed * l, exact.momentum(&tb));
        let (top, height) = exact.highest().unwrap();
        prop_assert_eq!(exact.momentum(&top), q(0, 1));
        prop_assert_eq!(exact.centre(&top).0, height);
        prop_assert!(top >= tb);
    }
}

#[test]
fn corollary_1_and_the_remarks_of_section_4() {
    let rod = |mu| UndampedContact::new(&parameters(q(1, 1), q(1, 1), q(1, 1), mu)).unwrap();
    assert_eq!(rod(q(3, 2)).bounce_time(), q(5, 2));
    assert_eq!(rod(q(2, 1)).bounce_time(), q(2, 1));
    assert_eq!(rod(q(4, 3)).energy_restitution_squared(), Some(q(5, 9)));
    assert_eq!(rod(q(3, 1)).energy_restitution_squared(), Some(q(23, 27)));
    let weightless = UndampedContact::new(&parameters(q(1, 1), q(1, 1), q(0, 1), q(1, 8))).unwrap();
    assert_eq!(weightless.bounce_time(), q(2, 1));
    assert_eq!(weightless.highest(), None);
    assert_eq!(weightless.strain(&q(2, 1), Side::Left), q(-1, 8));
    assert_eq!(weightless.strain(&q(2, 1), Side::Right), q(0, 1));
}

#[test]
fn a_damped_rod_is_refused() {
    let mut rod = parameters(q(1, 1), q(1, 1), q(1, 1), q(1, 1));
    rod.damping = q(1, 1000);
    assert!(UndampedContact::new(&rod).is_none());
}
