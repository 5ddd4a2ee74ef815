//! Small contact codes as others write them, whose data are compared.

/// A rod that hits the ground at `t = 0`, in `elements` of one length.
#[derive(Clone, Copy)]
pub(crate) struct Rod {
    pub(crate) length: f64,
    pub(crate) modulus: f64,
    pub(crate) density: f64,
    pub(crate) area: f64,
    pub(crate) gravity: f64,
    /// `r`, in the θ-scheme and in HHT; the others have none.
    pub(crate) damping: f64,
    pub(crate) speed: f64,
    pub(crate) elements: usize,
    /// The factor of the masses of both end nodes.
    pub(crate) ends: f64,
}

/// The bar of Doyen, Ern and Piperno.
pub(crate) const BAR: Rod = Rod {
    length: 10.0,
    modulus: 900.0,
    density: 1.0,
    area: 1.0,
    gravity: 10.0,
    damping: 0.0,
    speed: 10.0,
    elements: 400,
    ends: 1.0,
};

/// A steel bar of a square centimetre.
pub(crate) const STEEL: Rod =
    Rod { length: 1.0, modulus: 2e11, density: 8000.0, area: 1e-4, gravity: 9.81, speed: 1.0, ..BAR };

/// The output of a code at a time.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Row {
    pub(crate) t: f64,
    pub(crate) u: f64,
    pub(crate) v: f64,
    pub(crate) force: f64,
    pub(crate) u_top: f64,
    pub(crate) v_top: f64,
    pub(crate) h: f64,
    pub(crate) h_rate: f64,
    pub(crate) energy: f64,
}

/// A scheme for motion and contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Scheme {
    /// Leapfrog at CFL = 1, with a penalty at the end of the step.
    Penalty,
    /// Newmark with β = ¼, γ = ½; a node that would go below the ground is put on it and stopped.
    Projection,
    /// Symplectic Euler at a share of CFL = 1; a node that would go below the ground is stopped where it is.
    Moreau(f64),
    /// The θ-scheme at a share of CFL = 1, with the same impact; θ = 1 is backward Euler.
    Theta(f64, f64),
    /// HHT with α = −0.1 at CFL = ½, and a spring of so many times the stiffness of an element at the ground.
    Hht(f64),
    /// The mass of the node at the ground moved to the next two, total and centre unchanged; velocity Verlet.
    Redistribution,
}

/// The schemes that faults are tried with.
pub(crate) const SCHEMES: [Scheme; 9] = [
    Scheme::Penalty,
    Scheme::Projection,
    Scheme::Redistribution,
    Scheme::Moreau(0.5),
    Scheme::Moreau(0.9),
    Scheme::Theta(0.5, 0.5),
    Scheme::Theta(1.0, 0.25),
    Scheme::Hht(1.0),
    Scheme::Hht(4.0),
];

/// Multiples of `dt`, from this one on, up to `end`.
fn times(first: u32, dt: f64, end: f64) -> impl Iterator<Item = f64> {
    (first..).map(move |n| f64::from(n) * dt).take_while(move |t| *t <= end)
}

impl Rod {
    fn wave_speed(&self) -> f64 {
        (self.modulus / self.density).sqrt()
    }

    fn width(&self) -> f64 {
        self.length / self.elements as f64
    }

    fn stiffness(&self) -> f64 {
        self.modulus * self.area / self.width()
    }

    fn masses(&self) -> Vec<f64> {
        let mut masses = vec![self.density * self.area * self.width(); self.elements + 1];
        masses[0] *= self.ends / 2.0;
        masses[self.elements] *= self.ends / 2.0;
        masses
    }

    /// `−K u` and the weight at each node.
    fn forces(&self, u: &[f64]) -> Vec<f64> {
        let k = self.stiffness();
        let mut forces: Vec<f64> = self.masses().iter().map(|mass| -mass * self.gravity).collect();
        for i in 1..u.len() {
            let pull = k * (u[i] - u[i - 1]);
            forces[i] -= pull;
            forces[i - 1] += pull;
        }
        forces
    }

    fn row(&self, t: f64, u: &[f64], v: &[f64], masses: &[f64], force: f64) -> Row {
        let total: f64 = masses.iter().sum();
        let mean = |values: &[f64]| masses.iter().zip(values).map(|(m, x)| m * x).sum::<f64>() / total;
        let kinetic: f64 = masses.iter().zip(v).map(|(m, v)| m * v * v / 2.0).sum();
        let strain: f64 = u.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
        let energy = kinetic + self.stiffness() * strain / 2.0 + self.gravity * total * mean(u);
        Row {
            t,
            u: u[0],
            v: v[0],
            force,
            u_top: u[self.elements],
            v_top: v[self.elements],
            h: mean(u),
            h_rate: mean(v),
            energy,
        }
    }

    /// The text of its scene.
    pub(crate) fn scene(&self, time: f64) -> String {
        let Rod { length, modulus, density, area, gravity, damping, speed, .. } = self;
        format!(
            "rod = {{ length = {length}, modulus = {modulus:e}, density = {density}, area = {area:e}, damping = \
             {damping} }}\nimpact.speed = {speed}\ngravity.acceleration = {gravity}\nrun.time = {time:e}\n"
        )
    }

    /// Places, velocities and the output at the start.
    fn start(&self) -> (Vec<f64>, Vec<f64>, Vec<Row>) {
        let (u, v) = (vec![0.0; self.elements + 1], vec![-self.speed; self.elements + 1]);
        let rows = vec![self.row(0.0, &u, &v, &self.masses(), 0.0)];
        (u, v, rows)
    }

    /// The motion up to `end`.
    pub(crate) fn run(&self, scheme: Scheme, end: f64) -> Vec<Row> {
        match scheme {
            Scheme::Moreau(share) => self.theta((0.0, share), end),
            Scheme::Theta(theta, share) => self.theta((theta, share), end),
            Scheme::Hht(spring) => self.hht(spring, end),
            Scheme::Penalty => self.penalty(end),
            Scheme::Projection => self.projection(end),
            Scheme::Redistribution => self.redistribution(end),
        }
    }

    fn penalty(&self, end: f64) -> Vec<Row> {
        let (masses, dt) = (self.masses(), self.width() / self.wave_speed());
        let zero = vec![0.0; masses.len()];
        let step = |now: &[f64], last: &[f64]| -> (Vec<f64>, f64) {
            let forces = self.forces(now);
            let mut next: Vec<f64> =
                (0..now.len()).map(|i| 2.0 * now[i] - last[i] + dt * dt * forces[i] / masses[i]).collect();
            let free = next[0];
            // A spring m₀/dt² below the ground, at the new time.
            next[0] = if free < 0.0 { free / 2.0 } else { free };
            let push = masses[0] * (next[0] - free) / (dt * dt);
            (next, push)
        };
        // Before the impact the rod falls as a whole.
        let mut last = vec![self.speed * dt - self.gravity * dt * dt / 2.0; masses.len()];
        let mut now = zero;
        let half = |a: &[f64], b: &[f64]| -> f64 {
            let kinetic: f64 = (0..a.len()).map(|i| masses[i] * ((b[i] - a[i]) / dt).powi(2) / 2.0).sum();
            let k = self.stiffness();
            let strain: f64 = (1..a.len()).map(|i| (a[i] - a[i - 1]) * (b[i] - b[i - 1])).sum();
            let height: f64 = (0..a.len()).map(|i| masses[i] * f64::midpoint(a[i], b[i])).sum();
            kinetic + k * strain / 2.0 + self.gravity * height
        };
        let mut rows = Vec::new();
        for t in times(0, dt, end) {
            let (next, force) = step(&now, &last);
            let v: Vec<f64> = next.iter().zip(&last).map(|(a, b)| (a - b) / (2.0 * dt)).collect();
            let energy = f64::midpoint(half(&last, &now), half(&now, &next));
            rows.push(Row { energy, ..self.row(t, &now, &v, &masses, force) });
            (last, now) = (now, next);
        }
        rows
    }

    /// `(M + a K) x = right`, with a spring at the first node that counts as part of K, or that node given.
    fn solve(&self, a: f64, spring: f64, right: &[f64], first: Option<f64>) -> Vec<f64> {
        let (masses, k, count) = (self.masses(), self.stiffness(), right.len());
        let (mut upper, mut x) = (vec![0.0; count], vec![0.0; count]);
        for i in 0..count {
            if let (0, Some(first)) = (i, first) {
                x[0] = first;
                continue;
            }
            let own = if i == 0 || i == count - 1 { 1.0 } else { 2.0 };
            let below = if i == 0 { 0.0 } else { -a * k };
            let before = if i == 0 { (0.0, 0.0) } else { (upper[i - 1], x[i - 1]) };
            let more = if i == 0 { a * spring } else { 0.0 };
            let pivot = masses[i] + a * k * own + more - below * before.0;
            upper[i] = -a * k / pivot;
            x[i] = (right[i] - below * before.1) / pivot;
        }
        for i in (0..count - 1).rev() {
            x[i] -= upper[i] * x[i + 1];
        }
        x
    }

    /// The θ-scheme for the velocities and the places, θ = 0 being symplectic Euler, with an impact that stops.
    fn theta(&self, (theta, share): (f64, f64), end: f64) -> Vec<Row> {
        let (masses, dt) = (self.masses(), share * self.width() / self.wave_speed());
        let count = masses.len();
        let (mut u, mut v, mut rows) = self.start();
        for t in times(1, dt, end) {
            let part = if theta == 0.0 { 1.0 } else { theta };
            let guess: Vec<f64> = (0..count).map(|i| u[i] + dt * theta * (1.0 - theta) * v[i]).collect();
            let forces = self.forces(&guess);
            let a = (dt * theta).powi(2);
            let slowed = 1.0 - 2.0 * self.damping * dt;
            let right: Vec<f64> = (0..count).map(|i| masses[i] * v[i] * slowed + dt * forces[i]).collect();
            let mut next = self.solve(a, 0.0, &right, None);
            let reach = u[0] + dt * ((1.0 - part) * v[0] + part * next[0]);
            let mut force = 0.0;
            if (u[0] <= 0.0 || reach < 0.0) && next[0] < 0.0 {
                next = self.solve(a, 0.0, &right, Some(0.0));
                let k = self.stiffness();
                force = (a * k * (next[0] - next[1]) - right[0]) / dt;
            }
            for i in 0..count {
                u[i] += dt * ((1.0 - part) * v[i] + part * next[i]);
            }
            v = next;
            rows.push(self.row(t, &u, &v, &masses, force));
        }
        rows
    }

    /// Newmark's scheme with a force of the time `1 + α`, and a spring at the ground.
    fn hht(&self, spring: f64, end: f64) -> Vec<Row> {
        let (masses, dt, alpha) = (self.masses(), self.width() / self.wave_speed() / 2.0, -0.1);
        let (beta, gamma) = ((1.0_f64 - alpha).powi(2) / 4.0, 0.5 - alpha);
        let (count, spring) = (masses.len(), spring * self.stiffness());
        let (mut u, mut v, mut rows) = self.start();
        let mut a = vec![-self.gravity + 2.0 * self.damping * self.speed; count];
        for t in times(1, dt, end) {
            let whole = 1.0 + alpha;
            let guess: Vec<f64> = (0..count).map(|i| u[i] + dt * v[i] + dt * dt * (0.5 - beta) * a[i]).collect();
            let middle: Vec<f64> = (0..count).map(|i| whole * guess[i] - alpha * u[i]).collect();
            let of = |touches: bool| {
                let mut right = self.forces(&middle);
                let k = if touches { spring } else { 0.0 };
                right[0] -= k * middle[0];
                (0..count).for_each(|i| right[i] -= 2.0 * self.damping * masses[i] * (v[i] + whole * dt * a[i]));
                self.solve(whole * beta * dt * dt, k, &right, None)
            };
            let free = of(false);
            let depth = |a: &[f64]| middle[0] + whole * beta * dt * dt * a[0];
            let touches = depth(&free) < 0.0;
            let next = if touches { of(true) } else { free };
            let push = if touches { -spring * depth(&next) } else { 0.0 };
            u = (0..count).map(|i| guess[i] + beta * dt * dt * next[i]).collect();
            v = (0..count).map(|i| v[i] + dt * ((1.0 - gamma) * a[i] + gamma * next[i])).collect();
            a = next;
            let mut row = self.row(t, &u, &v, &masses, push);
            row.energy += if u[0] < 0.0 && touches { spring * u[0] * u[0] / 2.0 } else { 0.0 };
            rows.push(row);
        }
        rows
    }

    fn projection(&self, end: f64) -> Vec<Row> {
        let (masses, dt) = (self.masses(), self.width() / self.wave_speed());
        let (quarter, count) = (dt * dt / 4.0, masses.len());
        let (mut u, mut v, mut rows) = self.start();
        let mut a: Vec<f64> = vec![-self.gravity; count];
        for t in times(1, dt, end) {
            let guess: Vec<f64> = (0..count).map(|i| u[i] + dt * v[i] + quarter * a[i]).collect();
            let right = self.forces(&guess);
            let mut next = self.solve(quarter, 0.0, &right, None);
            let lands = guess[0] + quarter * next[0] < 0.0;
            if lands {
                next = self.solve(quarter, 0.0, &right, Some(-guess[0] / quarter));
            }
            u = (0..count).map(|i| guess[i] + quarter * next[i]).collect();
            v = (0..count).map(|i| v[i] + dt / 2.0 * (a[i] + next[i])).collect();
            a = next;
            let mut force = 0.0;
            if lands {
                (v[0], a[0]) = (0.0, 0.0);
                force = -self.forces(&u)[0];
            }
            rows.push(self.row(t, &u, &v, &masses, force));
        }
        rows
    }

    fn redistribution(&self, end: f64) -> Vec<Row> {
        let (mut masses, dt) = (self.masses(), self.width() / self.wave_speed() / 2.0);
        let (k, count, weight) = (self.stiffness(), masses.len(), masses[0] * self.gravity);
        // m₀ goes as m₀ (2, −1) to the nodes 1 and 2: the same sum and the same first moment.
        masses[1] += 2.0 * masses[0];
        masses[2] -= masses[0];
        masses[0] = 0.0;
        // The end without mass is in equilibrium.
        let place = |u: &mut Vec<f64>| -> f64 {
            u[0] = u[1] - weight / k;
            if u[0] >= 0.0 {
                return 0.0;
            }
            u[0] = 0.0;
            weight - k * u[1]
        };
        let accelerations = |u: &[f64]| -> Vec<f64> {
            let forces = self.forces(u);
            (0..count).map(|i| if i == 0 { 0.0 } else { forces[i] / masses[i] }).collect()
        };
        let mut u = vec![0.0; count];
        let mut v = vec![-self.speed; count];
        let mut force = place(&mut u);
        let mut a = accelerations(&u);
        let mut rows = Vec::new();
        for t in times(0, dt, end) {
            v[0] = if force > 0.0 { 0.0 } else { v[1] };
            rows.push(self.row(t, &u, &v, &masses, force));
            u = (0..count).map(|i| u[i] + dt * v[i] + dt * dt / 2.0 * a[i]).collect();
            force = place(&mut u);
            let next = accelerations(&u);
            v = (0..count).map(|i| v[i] + dt / 2.0 * (a[i] + next[i])).collect();
            a = next;
        }
        rows
    }
}

/// The rows as columns of data.
#[allow(clippy::type_complexity, reason = "names and readers of a table")]
pub(crate) fn columns(rows: &[Row]) -> Vec<(&'static str, Vec<f64>)> {
    let pick: [(&str, fn(&Row) -> f64); 9] = [
        ("t", |row| row.t),
        ("u", |row| row.u),
        ("v", |row| row.v),
        ("force", |row| row.force),
        ("u_top", |row| row.u_top),
        ("v_top", |row| row.v_top),
        ("h", |row| row.h),
        ("h_rate", |row| row.h_rate),
        ("E_total", |row| row.energy),
    ];
    pick.map(|(name, value)| (name, rows.iter().map(value).collect())).into()
}
