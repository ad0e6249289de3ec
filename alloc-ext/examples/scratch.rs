use meshsweep_alloc::*;
use meshsweep_alloc::collapse::*;
fn main(){
    let name=std::env::args().nth(1).unwrap(); let prio=if std::env::args().nth(2).as_deref()==Some("2"){Priority::Span}else{Priority::Program};
    let eps:f64=std::env::args().nth(3).map_or(1e-3,|x|x.parse().unwrap());
    let t=std::time::Instant::now();
    let (m,_r)=mesh::repair(mesh::read(std::path::Path::new(&format!("/work/shared/meshes/{name}.ply"))).unwrap()).unwrap();
    mesh::require_closed_manifold(&m).unwrap();
    println!("read {:.3}",t.elapsed().as_secs_f64());
    let s=precision::store(&m,precision::VertexBits::Auto);
    println!("{:?} err {}",s.grid,s.surface_error);
    let vol:f64=m.triangles.iter().map(|t|{let [a,b,c]=t.map(|v|s.positions[v as usize]);a.dot(b.cross(c))}).sum::<f64>()/6.0;
    let t=std::time::Instant::now();
    let mut e=Engine::new(&s.positions,&m.triangles,Conditions{second_term:eps,..Default::default()},prio,s.grid);
    println!("init {:.3}",t.elapsed().as_secs_f64());
    for target in [2000,200,0]{ let st=e.run(target,|_|{}); println!("{:?} {:?} t={:.3} void={:.2}%",e.progress(),st,t.elapsed().as_secs_f64(),e.added_volume()/vol*100.0); }
}
