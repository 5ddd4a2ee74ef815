//! Tests of the columns of each bar, by names written out by hand.

use dalembert::chain::{Body, Chain, Spring};

use super::Bar;
use crate::data::Source;
use crate::{Limit, Options};

/// A bar, a rigid mass on a spring, and a bar.
fn chain() -> Chain {
    let bar = || Body::new(1.into(), 1.into(), 1.into());
    let spring = Spring { stiffness: 2.into(), damping: 0.into() };
    let chain = Chain::builder(bar()).contact(0.into(), Body::rigid(3.into())).contact(0.into(), bar());
    chain.spring(2, spring).until(4.into()).build().unwrap()
}

#[test]
fn each_bar_has_its_own_columns() {
    let chain = chain();
    let names = ["t", "u_end.1", "u.3", "force.bottom", "force.1", "force.2 [N]", "force.top", "v_end.2", "u_end.4"];
    let of = |body: usize| names.map(|name| Bar { chain: &chain, body }.column(name).unwrap_or_default());
    assert_eq!(of(0), ["t", "u_end", "", "force", "force_top", "", "", "", "u_end.4"]);
    assert_eq!(of(2), ["t", "", "u", "", "", "force [N]", "force_top", "", "u_end.4"]);
    for (header, body) in [("force.bottom", 0), ("force.1", 0), ("u_end.1", 0), ("force.2", 2), ("force.top", 2)] {
        let bar = Bar { chain: &chain, body };
        assert_eq!(bar.column(header).map(|name| bar.header(&name)).as_deref(), Some(header));
    }
    // A rigid mass has no waves to compare.
    assert_eq!(of(1), ["t", "", "", "", "", "", "", "", "u_end.4"]);
}

#[test]
fn bars_are_those_of_the_map_or_of_the_names() {
    let chain = chain();
    let source = |names: &[&str]| {
        let columns = names.iter().map(|_| Ok(vec![0.0, 1.0])).collect();
        Source::from_columns("mine", names.iter().map(|name| (*name).to_string()).collect(), columns)
    };
    let bars = |source: &Source, options: &Options| {
        Bar::of(&chain, source, options).into_iter().map(|bar| bar.body).collect::<Vec<_>>()
    };
    assert_eq!(bars(&source(&["t", "force.1", "u_top.3"]), &Options::default()), [0, 2]);
    assert_eq!(bars(&source(&["t", "u", "v_end.2"]), &Options::default()), Vec::<usize>::new());
    let options = Options { map: Some("t=0, u_end.3=1,force.1=2".into()), ..Options::default() };
    assert_eq!(bars(&source(&["a", "b", "c"]), &options), [0, 2]);
    let upper = Bar { chain: &chain, body: 2 };
    assert_eq!(upper.options(&options).map.as_deref(), Some("t=0,u_end=1"));
    let named = |options: &Options| upper.source(source(&["t", "force.1", "u_top.3"]), options).head.names;
    assert_eq!(named(&Options::default()), ["t", "", "u_top"]);
    assert_eq!(named(&options), ["t", "force.1", "u_top.3"]);
}

#[test]
fn bounds_may_name_a_body() {
    let chain = chain();
    let upper = Bar { chain: &chain, body: 2 };
    let limit = |text: &str| upper.limit(&text.parse::<Limit>().unwrap()).map(|limit| limit.to_string());
    assert_eq!(limit("u_end.3.l2=0.5").as_deref(), Some("u_end.l2 ≤ 5e-1"));
    assert_eq!(limit("order.force.2=0.5").as_deref(), Some("order.force ≤ 5e-1"));
    assert_eq!(limit("u.l2=0.5").as_deref(), Some("u.l2 ≤ 5e-1"));
    assert_eq!(limit("energy=0.5").as_deref(), Some("energy ≤ 5e-1"));
    assert_eq!(limit("u_end.1.l2=0.5"), None);
}
