//! Questions to a motion that the motion inside it answers.

/// Forwards the questions without a time to `self.engine`; `$read` converts the numbers of its answers to `$number`.
macro_rules! forwarded {
    ($number:ty, $read:expr) => {
        fn end(&self) -> $number {
            $read(self.engine.end())
        }
        fn ending(&self) -> &$crate::motion::Ending {
            self.engine.ending()
        }
        fn warnings(&self) -> &[$crate::reason::Warning] {
            self.engine.warnings()
        }
        fn contact_times(&self, contact: usize) -> Option<($number, Option<$number>)> {
            self.engine.contact_times(contact).map(|(impact, release)| ($read(impact), release.map($read)))
        }
        fn impulse(&self, contact: usize) -> Option<$number> {
            self.engine.impulse(contact).map($read)
        }
        fn stress_pieces(&self) -> Vec<$crate::motion::StressPiece<$number>> {
            self.engine.stress_pieces().into_iter().map(|piece| piece.map($read)).collect()
        }
        fn highest(&self, release: usize) -> Option<($number, $number)> {
            self.engine.highest(release).map(|(time, height)| ($read(time), $read(height)))
        }
        fn rays(&self, trip: usize) -> Result<Vec<$crate::motion::Ray<$number>>, Error> {
            Ok(self.engine.rays(trip)?.into_iter().map(|ray| ray.map($read)).collect())
        }
        fn departures(&self) -> Result<[Vec<($number, $number)>; 2], Error> {
            let ends = self.engine.departures()?;
            Ok(ends.map(|rays| rays.into_iter().map(|(time, jump)| ($read(time), $read(jump))).collect()))
        }
        fn corners(&self) -> Vec<$number> {
            self.engine.corners().into_iter().map($read).collect()
        }
        fn waves(&self) -> Result<$crate::motion::Waves<$number>, Error> {
            Ok(self.engine.waves()?.map($read))
        }
        fn error_estimate(&self) -> $number {
            $read(self.engine.error_estimate())
        }
        fn digits_lost(&self) -> Option<(u32, f64)> {
            self.engine.digits_lost()
        }
    };
}

pub(super) use forwarded;
