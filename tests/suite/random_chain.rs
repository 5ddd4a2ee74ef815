//! Random chains, for the tests of the library and those inside it.

use dalembert::Number;
use dalembert::chain::{Body, Chain, End, Points};

/// A generator of small numbers.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn below(&mut self, n: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) % n
    }

    pub(crate) fn positive(&mut self) -> Number {
        format!("{}/{}", 1 + self.below(5), 1 + self.below(4)).parse().unwrap()
    }

    pub(crate) fn signed(&mut self) -> Number {
        format!("{}/{}", self.below(9) as i64 - 4, 1 + self.below(3)).parse().unwrap()
    }

    fn points(&mut self) -> Points {
        let ramp = vec![(0.into(), self.signed()), (1.into(), self.signed())];
        let jump = [(1.into(), self.signed()), ("5/2".parse().unwrap(), self.signed())];
        if self.below(2) == 0 { ramp } else { ramp.into_iter().chain(jump).collect() }
    }

    pub(crate) fn body(&mut self) -> Body {
        let body = Body::new(self.positive(), self.positive(), self.positive());
        if self.below(3) > 0 {
            return body.with_velocity(self.signed());
        }
        let ends = || [0.into(), body.length().clone()];
        let displacement = ends().into_iter().zip([0.into(), self.signed()]).collect();
        let velocity = ends().into_iter().zip([self.signed(), self.signed()]).collect();
        body.clone().with_start(velocity, displacement)
    }

    pub(crate) fn end(&mut self) -> End {
        match self.below(8) {
            0 => End::Free,
            1 => End::Force(self.points()),
            2 => End::Velocity(Vec::new()),
            3 => End::Velocity(self.points()),
            4 => End::Ground { gap: self.positive(), velocity: Vec::new() },
            5 => End::Ground { gap: self.positive(), velocity: self.points() },
            6 => End::Infinite { impedance: Some(self.positive()), gap: None },
            _ => End::Infinite { impedance: Some(self.positive()), gap: Some(self.positive()) },
        }
    }

    pub(crate) fn chain(&mut self) -> Chain {
        let mut builder = Chain::builder(self.body()).bottom(self.end()).top(self.end()).until(6.into());
        for _ in 0..=self.below(4) {
            let gap = if self.below(4) == 0 { 0.into() } else { self.positive() };
            let is_bonded = self.below(3) == 0;
            let body = self.body();
            builder = if is_bonded { builder.bonded(body) } else { builder.contact(gap, body) };
        }
        let gravity = if self.below(2) == 0 { 0.into() } else { self.positive() };
        builder.gravity(gravity).build().unwrap()
    }
}
