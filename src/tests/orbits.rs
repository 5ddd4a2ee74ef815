use super::*;
use crate::motion::Side;
use crate::problem::Builder;

fn fraction(p: i64, q: i64) -> Rational {
    Rational::from(p) / Rational::from(q)
}

fn exact(orbit: &Orbit, rod: &Problem) -> Option<OrbitValues> {
    orbit.values(rod, &Units::default(), &1.into(), Numbers::Exact).unwrap()
}

fn number(value: &Value) -> Rational {
    value.as_rational().unwrap().clone()
}

fn free() -> Builder {
    Problem::builder().length(3).wave_speed(2).gravity("5/7").impact_speed(1)
}

/// A held rod at rest whose lower end hangs clear of the ground, on it, or is pressed on it.
fn held(end: &str) -> Builder {
    let length = Problem::builder().length(3).wave_speed(2).fixed_top();
    length.displacement([(0, "0"), (3, end)]).velocity([(0, 0), (3, 0)])
}

/// Follows an orbit through three periods by the engine of the lattice, which knows neither cells nor periods.
fn returns(orbit: &Orbit, rod: &Problem) {
    let Some(values) = exact(orbit, rod) else { return };
    let start = orbit.start(rod, &1.into(), 3).unwrap().unwrap();
    let history = start.exact().unwrap();
    let (period, contact) = (number(&values.period), number(&values.contact));
    let contacts = history.contacts();
    let named = format!("{orbit:?}");
    // The impact at the end of the run may be listed.
    assert!((3..=4).contains(&contacts.len()), "{named}: {} contacts", contacts.len());
    for (k, found) in contacts.iter().take(3).enumerate() {
        let impact = period.clone() * Rational::from(k as i64);
        assert_eq!(found.impact, impact, "{named}");
        assert_eq!(found.release, Some(impact + &contact), "{named}");
    }
    let places: Vec<Rational> = (0..=24).map(|k| start.length().to_rational() * fraction(k, 24)).collect();
    let [first, second] = [0, 2].map(|k| period.clone() * Rational::from(k));
    let fields = |time: &Rational| history.field(&places, std::slice::from_ref(time), Side::Right).unwrap();
    assert_eq!(fields(&first), fields(&second), "{named}");
    assert_eq!(number(&values.energy), history.energy(first.clone()).unwrap().total, "{named}");
    let (height, speed) = history.ground_end(period.clone(), Side::Left).unwrap();
    assert_eq!((height, -speed), (Rational::default(), number(&values.impact_speed)), "{named}");
    let (_, speed) = history.ground_end(contact.clone(), Side::Right).unwrap();
    assert_eq!(speed, number(&values.impact_speed), "{named}");
    // The lower end turns between two cells.
    let cells = 2 * orbit.waves.len() as i64;
    let times = (0..=cells).map(|k| period.clone() * fraction(k, cells));
    let highest = times.map(|time| history.ground_end(time, Side::Right).unwrap().0).max().unwrap();
    assert_eq!(highest, number(&values.height), "{named}");
}

#[test]
fn a_free_rod_returns_to_its_start() {
    let orbits = Orbit::up_to(Top::Free, 7, 5).unwrap();
    assert!(orbits.len() > 50);
    let rod = free().build().unwrap();
    orbits.iter().for_each(|orbit| returns(orbit, &rod));
}

#[test]
fn a_held_rod_returns_to_its_start() {
    let orbits = Orbit::up_to(Top::Fixed, 9, 3).unwrap();
    let rods = ["1/2", "0", "-2/5"].map(|end| held(end).build().unwrap());
    let heavy = ["1/2", "135/112", "3"].map(|end| held(end).gravity("15/14").build().unwrap());
    for rod in rods.iter().chain(&heavy) {
        let found = orbits.iter().filter(|orbit| exact(orbit, rod).is_some()).count();
        assert!(found > 0, "{rod:?}");
        orbits.iter().for_each(|orbit| returns(orbit, rod));
    }
}

/// One branch begins with the vibration of the clamped rod, of the period `4L/c`, and ends where rigid flights begin.
#[test]
fn the_first_branch_of_a_free_rod_has_a_closed_form() {
    let rod = Problem::builder().length(1).wave_speed(2).gravity(1).impact_speed(1).build().unwrap();
    let mut found = 0;
    for orbit in Orbit::up_to(Top::Free, 24, 3).unwrap() {
        let (period, contact) = (orbit.period_ratio(), orbit.contact_ratio());
        if !orbit.is_of_first_branch() {
            continue;
        }
        assert_eq!(contact + &period, Rational::from(4));
        let values = exact(&orbit, &rod).unwrap();
        // E − E_rest = ½ (T/t₁ − 2) L (g t₁)², with g t₁ = 1.
        assert_eq!(number(&values.excess), (period - Rational::from(2)) * fraction(1, 2));
        assert_eq!(number(&values.impact_speed), fraction(1, 2));
        found += 1;
    }
    // Every fraction above 2 and up to 3.
    let fractions = (1..=24).map(|n| (1..=n).filter(|k| gcd(*k, n) == 1).count()).sum::<usize>();
    assert_eq!(found, fractions);
}

/// The first nonsmooth mode: with `L = c = 1` and the gap ½ the impact speed is `½/(T − 3)`, the contact lasts `4 − T`.
#[test]
fn the_first_nonsmooth_mode_has_a_closed_form() {
    let rod = Problem::builder().length(1).wave_speed(1).fixed_top().gap("1/2").impact_speed(1).build().unwrap();
    for cells in 301..=380 {
        let orbits = Orbit::of_period(Top::Fixed, cells, 200).unwrap();
        let period = fraction(cells.into(), 100);
        let first = orbits.iter().find(|orbit| orbit.is_of_first_branch());
        let values = exact(first.unwrap(), &rod).unwrap();
        let speed = fraction(1, 2) / (period.clone() - Rational::from(3));
        assert_eq!(number(&values.impact_speed), speed);
        assert_eq!(number(&values.contact), Rational::from(4) - period);
        assert_eq!(number(&values.energy), speed.clone() * speed / Rational::from(2));
    }
}

#[test]
fn the_demonstration_of_getfem_is_a_member() {
    let rod = held("0").length(1).wave_speed(1).displacement([(0, 0), (1, 0)]).velocity([(0, 0), (1, 0)]);
    let orbits = Orbit::of_period(Top::Fixed, 3, 2).unwrap();
    assert_eq!(orbits.len(), 1);
    let values = orbits[0].values(&rod.build().unwrap(), &Units::default(), &"1/2".parse().unwrap(), Numbers::Exact);
    let values = values.unwrap().unwrap();
    assert_eq!(
        [&values.period, &values.contact, &values.impact_speed].map(number),
        [3.into(), 1.into(), fraction(1, 2)]
    );
    assert_eq!([&values.height, &values.energy].map(number), [fraction(1, 2), fraction(1, 8)]);
}

#[test]
fn numbers_agree_and_are_within_their_bounds() {
    let rod = Problem::builder().length(1).modulus(2).density(1).gravity("5/7").impact_speed(1).build().unwrap();
    let orbit = &Orbit::of_period(Top::Free, 5, 2).unwrap()[0];
    let of = |numbers| orbit.values(&rod, &Units::default(), &1.into(), numbers).unwrap().unwrap();
    let (doubles, digits, proved) = (of(Numbers::Double(None)), of(Numbers::Digits(40)), of(Numbers::Certified(40)));
    let pairs = [
        (&doubles.period, &digits.period, &proved.period),
        (&doubles.energy, &digits.energy, &proved.energy),
        (&doubles.height, &digits.height, &proved.height),
    ];
    for (double, digits, proved) in pairs {
        assert_eq!(digits.to_string(), proved.to_digits(40));
        assert!((double.to_f64() - digits.to_f64()).abs() <= double.bound().to_f64());
    }
    assert!(matches!(orbit.values(&rod, &Units::default(), &1.into(), Numbers::Exact), Err(OrbitError::Numbers(_))));
}

#[test]
fn rods_without_orbits_are_refused_by_name() {
    let orbit = &Orbit::of_period(Top::Free, 5, 2).unwrap()[0];
    let refused = |rod: Builder| {
        let rod = rod.build().unwrap();
        orbit.values(&rod, &Units::default(), &1.into(), Numbers::Exact).unwrap_err().to_string()
    };
    assert_eq!(
        refused(free().damping("0.1")),
        "found the damping 0.1, expected an undamped rod: a damped one comes to rest"
    );
    let away = "found a free rod without gravity, expected gravity or a fixed top: it flies away for ever";
    assert_eq!(refused(free().gravity(0)), away);
    for (cells, round_trip) in [(0, 1), (1, 0), (30_001, 2), (1, 20_001)] {
        assert!(Orbit::of_period(Top::Free, cells, round_trip).is_err());
    }
}
