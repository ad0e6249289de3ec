use meshsweep_alloc::*; use meshsweep_core::*; use meshsweep_core::query::*; use meshsweep_core::refine::*;
fn main(){
    let name=std::env::args().nth(1).unwrap(); let base:usize=std::env::args().nth(2).map_or(200,|x|x.parse().unwrap());
    let (m,_r)=mesh::repair(mesh::read(std::path::Path::new(&format!("/work/shared/meshes/{name}.ply"))).unwrap()).unwrap();
    mesh::require_closed_manifold(&m).unwrap();
    let b=hull::build(&m,0.0,m.triangles.len(),&hull::BuildOptions{base_faces:base,..Default::default()},|_|{}).unwrap();
    println!("{:?}",b.report);
    std::fs::write(format!("/tmp/{name}.msw"),&b.bytes).unwrap(); let model=Model::open(&b.bytes).unwrap();
    let n=m.triangles.len() as f64;
    println!("total {:.1} B/tri nodes {} cap {:?}",b.bytes.len() as f64/n, model.header().nodes, model.capacities());
    for s in model.sections(){ println!("  {} {:.2}",s.kind.name(),s.bytes as f64/n);}
    for l in model.levels(){println!("  {l:?}");}
    let mut rng=12345u64; let mut r=||{rng^=rng<<13;rng^=rng>>7;rng^=rng<<17;(rng>>11) as f64/(1u64<<53) as f64};
    let lo=(0..3).map(|k|m.positions.iter().map(|p|p[k]).fold(f32::MAX,f32::min) as f64).collect::<Vec<_>>();
    let hi=(0..3).map(|k|m.positions.iter().map(|p|p[k]).fold(-f32::MAX,f32::max) as f64).collect::<Vec<_>>();
    let diag=(0..3).map(|k|(hi[k]-lo[k]).powi(2)).sum::<f64>().sqrt();
    let nq=10000;
    let far:Vec<[f32;3]>=(0..nq).map(|_|{let mut p=[0f32;3];for k in 0..3{let c=(lo[k]+hi[k])*0.5;p[k]=(c+(r()*2.0-1.0)*(hi[k]-lo[k])) as f32;}p}).collect();
    let near:Vec<[f32;3]>=(0..nq).map(|_|{let t=m.triangles[(r()*n) as usize];let p=m.positions[t[0] as usize];let mut q=p;for k in 0..3{q[k]+=((r()-0.5)*0.03*diag) as f32;}q}).collect();
    for qcap in [model.capacities().queue, 4096] { let mut q=vec![QueueEntry::EMPTY;qcap];
    for (nm,ps) in [("far",&far),("near",&near)]{
        let t=std::time::Instant::now(); let mut w=Work::default(); let mut s=0.0; let mut width=0f32;
        for p in ps{ let a=closest_point(&model,*p,&Stop::EXACT,&mut q).unwrap(); w.nodes+=a.work.nodes;w.triangles+=a.work.triangles;w.exact+=a.work.exact;w.splits+=a.work.splits; s+=a.upper as f64; assert!(a.ended==Ended::Exact); width=width.max((a.upper-a.lower)/a.upper); }
        println!("cap {qcap} {nm} {:.0} ns nodes {:.1} tris {:.1} exact {:.1} opened {:.1} sum {s} width {width:e}",t.elapsed().as_nanos() as f64/nq as f64,w.nodes as f64/nq as f64,w.triangles as f64/nq as f64,w.exact as f64/nq as f64,w.splits as f64/nq as f64);
    }}
    // brute check
    let mut q=vec![QueueEntry::EMPTY;4096];
    for p in far.iter().take(50).chain(near.iter().take(50)){ let a=closest_point(&model,*p,&Stop::EXACT,&mut q).unwrap();
        let pd=glam::DVec3::new(p[0] as f64,p[1] as f64,p[2] as f64);
        let mut best=f64::MAX; for t in &m.triangles{ let [x,y,z]=t.map(|v|{let p=m.positions[v as usize];glam::DVec3::new(p[0] as f64,p[1] as f64,p[2] as f64)}); let d=meshsweep_core::geom::point_triangle(pd,x,y,z); best=best.min(d.distance_sq.sqrt()); }
        assert!(a.lower as f64<=best*(1.0+1e-12) && best<=a.upper as f64*(1.0+1e-12),"{a:?} {best}");
    }
    // segments
    let side=|r:&mut dyn FnMut()->f64|{let mut p=[0f32;3];let ax=(r()*3.0) as usize;for k in 0..3{let c=(lo[k]+hi[k])*0.5;let h=hi[k]-lo[k];p[k]=(c+(if k==ax{if r()<0.5{-1.0}else{1.0}}else{r()*2.0-1.0})*h) as f32;}p};
    let segs:Vec<_>=(0..nq).map(|_|(side(&mut r),side(&mut r))).collect();
    let t=std::time::Instant::now(); let mut w=Work::default(); let mut hits=0; let mut ts=vec![];
    for (a,b) in &segs{ let h=first_hit(&model,*a,*b,&Stop::EXACT,&mut q).unwrap(); w.nodes+=h.work.nodes;w.triangles+=h.work.triangles;w.exact+=h.work.exact;w.splits+=h.work.splits; if h.hit.is_some(){hits+=1;} ts.push(h.hit); }
    println!("first_hit {:.0} ns hits {hits} nodes {:.1} tris {:.1} exact {:.2} opened {:.1}",t.elapsed().as_nanos() as f64/nq as f64,w.nodes as f64/nq as f64,w.triangles as f64/nq as f64,w.exact as f64/nq as f64,w.splits as f64/nq as f64);
    let wds=model.capacities().front_words; let mut pf=vec![0u32;wds]; let mut sw=vec![0u32;wds]; let mut cand=vec![Face::EMPTY;1024]; let mut hb=[Hit::EMPTY;64];
    for search in [Search::First,Search::Outer]{
    let t=std::time::Instant::now(); let mut w=Work::default(); let mut hits=0; let mut diff=0;
    for (i,(a,b)) in segs.iter().enumerate(){ let mut f=Front::new(&mut pf,&mut sw,&mut cand); let h=outer_hits(&model,*a,*b,search,&mut f,&mut hb).unwrap(); w.nodes+=h.work.nodes;w.triangles+=h.work.triangles;w.exact+=h.work.exact;w.splits+=h.work.splits; if h.stored>0{hits+=1;} let x=if h.stored>0{Some(hb[0])}else{None}; if x!=ts[i]{diff+=1; if diff<3 {println!("{x:?} {:?}",ts[i]);}} }
    println!("{search:?} {:.0} ns hits {hits} diff {diff} nodes {:.1} tests {:.1} exact {:.2} splits {:.1}",t.elapsed().as_nanos() as f64/nq as f64,w.nodes as f64/nq as f64,w.triangles as f64/nq as f64,w.exact as f64/nq as f64,w.splits as f64/nq as f64);
    }
}
