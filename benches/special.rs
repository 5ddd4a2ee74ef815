//! Bessel functions and the sums of a ray at 50, 300 and 1000 digits, each beside MPFR's `exp` and a product of the
//! same precision in the same run.
//!
//! Peers are measured on the same machine, in turns with this: `pip install python-flint mpmath gmpy2`, then
//! `flint.arb(z).bessel_i(n, scaled=True)` with `ctx.prec = 3322`; `mpmath.besseli(n, z) * mpmath.exp(-z)` with
//! `mp.prec = 3322`, and once more with `MPMATH_NOGMPY=1`. A short argument, `z = 10`, is cheaper than a long one,
//! `10 + √2/1000`, for everyone: compare like with like, and the least of several runs.
#![allow(missing_docs)]

use criterion::{Criterion, criterion_group, criterion_main};
fn special(criterion: &mut Criterion) {
    use std::hint::black_box;

    use dalembert::special::{Ray, Special, i0_scaled};
    use rug::Float;

    for digits in [50, 300, 1000] {
        let bits = dalembert::number::bits_for_digits(digits);
        let long = |x: f64| Float::with_val(bits, 2).sqrt() / 1000u32 + x;
        let short = Float::with_val(bits, 10);
        let (ten, three) = (long(10.0), long(3.0));
        let ray = Ray::new(&three, &long(1.0), &long(3.3));
        let mut group = criterion.benchmark_group(format!("{digits} digits"));
        group.bench_function("yardstick: product", |b| b.iter(|| Float::with_val(bits, black_box(&ten) * &three)));
        group.bench_function("yardstick: exp", |b| b.iter(|| Float::with_val(bits, black_box(&ten).exp_ref())));
        group.bench_function("e^{−z} I₀(10)", |b| b.iter(|| i0_scaled(black_box(&short))));
        group.bench_function("e^{−z} I₀(10.001…)", |b| b.iter(|| i0_scaled(black_box(&ten))));
        group.bench_function("e^{−z} I₅(10.001…)", |b| b.iter(|| black_box(&ten).in_scaled(5)));
        group.bench_function("sums of a ray, one", |b| b.iter(|| black_box(&ray).sums([1], |n| [n])));
        group.bench_function("sums of a ray, five", |b| {
            b.iter(|| black_box(&ray).sums([1, 2, 2, 1, 1], |n| [n % 2, 1 - n % 2, n * n / 4, n, (n * n + 1) / 2]));
        });
        group.finish();
    }
}

criterion_group!(benches, special);
criterion_main!(benches);
