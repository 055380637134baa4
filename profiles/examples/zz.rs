use profiles::*;
fn main() {
    let v = 0.004315238685738813;
    let limits = Limits::new(v, v, v).unwrap();
    let h = v;
    let s = SCurve::rest_to_rest(h, &limits).unwrap();
    let ms: Vec<Mode> =
        [(0.24064455297797718, 0.0), (0.5573149978736789, 0.36762405845943663), (0.42320218968690554, 0.0)]
            .iter()
            .map(|&(p, z)| Mode::new(std::f64::consts::TAU / (p * s.duration()), z).unwrap())
            .collect();
    let c = Chain::<95>::rest_to_rest(h, &limits, &ms).unwrap();
    println!("{:?} {:e}", c.links(), c.duration());
    for k in 0..95 {
        if let Some(s) = c.section(k) {
            if s.reach == 0.0 {
                continue;
            }
            println!(
                "{k} {:.17} {:.17} len {:e} p {:.6} {:.6}  a {:e} .. {:e} j {:e} s {:e}",
                s.start,
                s.end,
                s.reach,
                s.at_local(s.local_ends().0).position / h,
                s.at_local(s.local_ends().1).position / h,
                s.at_local(s.local_ends().0).acceleration / v,
                s.at_local(s.local_ends().1).acceleration / v,
                s.polynomial.jerk,
                s.polynomial.snap
            );
        }
    }
}
