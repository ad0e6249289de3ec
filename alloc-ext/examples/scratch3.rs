use meshsweep_core::*; use meshsweep_core::query::*;
#[inline(never)] pub fn q_far(m:&Model,p:[f32;3],q:&mut [QueueEntry])->f32{closest_point(m,p,&Stop::EXACT,q).unwrap().upper}
#[inline(never)] pub fn q_near(m:&Model,p:[f32;3],q:&mut [QueueEntry])->f32{closest_point(m,p,&Stop::EXACT,q).unwrap().upper}
#[inline(never)] pub fn q_seg(m:&Model,a:[f32;3],b:[f32;3],q:&mut [QueueEntry])->f32{first_hit(m,a,b,&Stop::EXACT,q).unwrap().upper}
fn main(){
    let f=std::env::args().nth(1).unwrap(); let n:usize=std::env::args().nth(2).map_or(1000,|x|x.parse().unwrap());
    let bytes=std::fs::read(f).unwrap(); let model=Model::open(&bytes).unwrap();
    let s=model.scale() as f32; let b=model.header().surface_box; let lo=(b.min*s).to_array(); let hi=(b.max*s).to_array();
    let diag=((b.max-b.min)*s).length();
    let mut rng=12345u64; let mut r=||{rng^=rng<<13;rng^=rng>>7;rng^=rng<<17;((rng>>11) as f64/(1u64<<53) as f64) as f32};
    let mut far=vec![];let mut near=vec![];let mut seg=vec![];
    for _ in 0..n{ far.push(std::array::from_fn(|k|(lo[k]+hi[k])*0.5+(r()*2.0-1.0)*(hi[k]-lo[k])));
      let t=(r()*model.header().surface_triangles as f32) as u32; let c=model.surface_triangle(blob::TriIdx(t)).unwrap(); let p=(model.position(c[0]).unwrap()*s).to_array(); near.push(std::array::from_fn(|k|p[k]+(r()-0.5)*0.03*diag));
      let mut side=||{let ax=(r()*3.0) as usize; let sg=if r()<0.5{-1.0}else{1.0}; std::array::from_fn(|k|(lo[k]+hi[k])*0.5+(if k==ax{sg}else{r()*2.0-1.0})*(hi[k]-lo[k]))}; seg.push((side(),side())); }
    let mut q=vec![QueueEntry::EMPTY;std::env::args().nth(3).map_or(4096,|x|x.parse().unwrap())]; let mut sum=0.0;
    for rep in 0..2{
    let t=std::time::Instant::now(); for p in &far{sum+=q_far(&model,*p,&mut q);} let a=t.elapsed().as_nanos()/n as u128;
    let t=std::time::Instant::now(); for p in &near{sum+=q_near(&model,*p,&mut q);} let b=t.elapsed().as_nanos()/n as u128;
    let t=std::time::Instant::now(); for p in &seg{sum+=q_seg(&model,p.0,p.1,&mut q);} let c=t.elapsed().as_nanos()/n as u128;
    if rep==1{println!("far {a} near {b} seg {c} ns  {sum}");} }
}
