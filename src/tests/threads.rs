use super::*;

#[test]
fn answers_come_in_order_and_the_first_error_ends_the_work() {
    for threads in 1..=3 {
        let threads = Threads(NonZero::new(threads).unwrap());
        let all = threads.all(1000, |k| Ok::<_, usize>(k * k)).unwrap();
        assert!(all.iter().enumerate().all(|(k, square)| *square == k * k) && all.len() == 1000);
        let refused = threads.all(1000, |k| if k >= 7 { Err(k) } else { Ok(k) });
        assert_eq!(refused, Err(7));
        assert_eq!(threads.all(0, Ok::<usize, ()>), Ok(Vec::new()));
    }
}
