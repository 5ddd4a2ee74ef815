//! The first contact as a sum over the modes `sin((2n+1)πx/2L)`: it shares no formula with the rays, and is stable late
//! in the contact, where every ray is large and their sum is small.
//!
//! With time in round trips, `τ = t/t₁`, `a = x/2L`, `ω = (2n+1)π`, `ε = 1/ω`, `Ω² = ω² − R²`, and with
//! `C = cos Ωτ`, `S = sin(Ωτ)/Ω` (cosh and sinh where `ω < R`, 1 and τ between), damped by `e^{−Rτ}`:
//!
//! | | for μ = 1 | for μ₀ = 1 |
//! |---|---|---|
//! | `v/t₁` | `−Σ 4ε S sin ωa` | `−a(1−a)/2 + Σ 4ε³ (C + RS) sin ωa` |
//! | `v_t` | `−Σ 4ε (C − RS) sin ωa` | `−Σ 4ε S sin ωa` |
//! | `c v_x` | `−Σ 4 S cos ωa` | `a − 1/2 + Σ 4ε² (C + RS) cos ωa` |
//! | `h/t₁` | `−Σ 8ε² S` | `−1/12 + Σ 8ε⁴ (C + RS)` |
//! | `h′` | `−Σ 8ε² (C − RS)` | `−Σ 8ε² S` |
//!
//! As they stand, `v` and `h` converge absolutely, `h` like `N⁻²` and `v` like `N⁻¹`; `v_t`, `v_x` and the stress of
//! the impact only conditionally, and not uniformly near a ray. What makes them slow is the lattice itself: as
//! functions of ε, `C` and `S` are `Re(F(−iε) e^{iωτ})` with F analytic, and the first K powers of ε add up to Euler
//! polynomials that jump and bend on the rays and nowhere else. They are added up in closed form; what is left
//! converges absolutely and uniformly, like `N^{1−K−p}` with the power p of the table.

mod motion;
mod sums;

pub use motion::Modal;
