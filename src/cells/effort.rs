//! How much is computed of a run.

/// How much is computed of a run at most.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Decimal digits of the natural scales that cells are marched to.
    pub digits: f64,
    /// Cells that are crossed.
    pub cells: u64,
    /// Whether the run is given up where its bounds no longer tell the events apart.
    pub until_lost: bool,
    /// Digits beyond which nothing is marched.
    pub most_digits: f64,
    /// A first contact of up to so many round trips is marched over; up to the second of them, it is if that is known
    /// better than the closed form.
    pub marched_trips: [f64; 2],
}

impl Effort {
    /// So many digits, however many cells they take.
    pub fn of(digits: f64) -> Self {
        Effort { digits, cells: u64::MAX, until_lost: false, most_digits: 300.0, marched_trips: [4.0, 64.0] }
    }
}

/// The most strips that are followed: some hundred megabytes.
pub(super) const MOST_PIECES: usize = 400_000;
/// The most segments of a round trip.
pub(super) const MOST_SEGMENTS: usize = 4096;
/// The fewest round trips that are leapt over: a leap costs about as much as two of them.
pub(super) const LEAST_LEAP: f64 = 3.0;
