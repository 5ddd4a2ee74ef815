use dalembert::lattice::*; use dalembert::number::*; use dalembert::rod::*;
#[test]
fn probe() {
    for mu in ["1","3","2","3/2"] {
    for t in [10i64,20,40,80,160,320] {
        let p = crate::common::uniform("1","1","1",mu,Run::Time(t.into()));
        let h = Undamped::<Estimate<f64>>::solve(&p,&()).unwrap();
        println!("{mu} {t} rel {:.3e} undetermined {:?}  events {} lasttime {:?}", h.ground().relative_error, h.undetermined_from(), h.ground().events.len(), h.ground().events.last().map(|e|e.age.error()));
    }}
}
#[test]
fn probe_top() {
    use dalembert::{History, Side};
    let p = crate::common::uniform("3/5","4/5","5/2","3/8",Run::Time(0.into()));
    let h = Undamped::<Interval>::solve(&p,&IntervalPrecision::with_exact(128)).unwrap();
    println!("{:?}", h.top_end(&h.end(), Side::Right));
    println!("{:?}", h.ending());
}
