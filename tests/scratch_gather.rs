use amas::frame::*; use amas::gpu::*; use amas::*; use std::sync::Arc; use std::path::Path; use std::collections::HashMap;
use amas::virtual_lights::{Tracer, VirtualTree}; use amas::passes::gather::GatheredLights;
fn compile(name: &str, defs: &[(String,String)]) -> Vec<u32> {
    let c = shaderc::Compiler::new().unwrap(); let mut o = shaderc::CompileOptions::new().unwrap();
    o.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_2 as u32);
    o.set_optimization_level(shaderc::OptimizationLevel::Performance);
    for (a,b) in defs { o.add_macro_definition(a, Some(b)); }
    o.add_macro_definition("XX", None); o.set_include_callback(|n,_,_,_| { let content = if n=="shared.glsl" { amas::shared::GLSL.replace("GATHER_DRAWN 32u","GATHER_DRAWN 16u") } else { std::fs::read_to_string(format!("glsl/{n}")).map_err(|e| e.to_string())? }; Ok(shaderc::ResolvedInclude{resolved_name:n.into(), content}) });
    let t = std::fs::read_to_string(format!("glsl/{name}")).unwrap();
    c.compile_into_spirv(&t, shaderc::ShaderKind::Compute, name, "main", Some(&o)).unwrap().as_binary().to_vec()
}
fn main_() {
    let e = |k: &str, d: &str| std::env::var(k).unwrap_or(d.into());
    let path = e("SCENE", "/tmp/ind/g1.toml"); let rounds: u32 = e("ROUNDS","1").parse().unwrap();
    let defs: Vec<(String,String)> = e("DEFS","").split(',').filter(|s| !s.is_empty()).map(|s| (s.to_string(), "1".to_string())).collect();
    let mut over: Vec<(String,String)> = vec![]; for kv in e("SET","").split(';').filter(|s| !s.is_empty()) { let (a,b)=kv.split_once('=').unwrap(); over.push((a.into(),b.into())); }
    let scene = amas::scene::load(Path::new(&path), &over).unwrap();
    let device = Gpu::open(&Options{device:None, validate:false}).unwrap();
    let mut map: HashMap<&'static str, Vec<u32>> = HashMap::new(); map.insert("gather/gather.comp", compile("gather/gather.comp", &defs)); device.replace_shaders(map);
    let gpu = Arc::new(GpuScene::new(&device,&scene).unwrap());
    let cam = &scene.cameras[0]; let settings = FrameSettings::new(&scene.render, cam);
    let t0=std::time::Instant::now();
    let mut frame = Frame::new(&device,&gpu,settings).unwrap(); println!("frame new {:.2}s", t0.elapsed().as_secs_f64());
    let inputs = FrameInputs{camera:cam,time:0.0,samples:scene.render.samples,exposure:0.0,split:false,progress:indicatif::ProgressBar::hidden()};
    frame.render(&inputs).unwrap();
    let tracer = frame.gathers().indirect.then(|| Tracer::new(&scene, gpu.origin));
    let points = VirtualTree::of_points(&scene.point_lights, gpu.origin);
    let (mut tc, mut gc, mut uc)=(0.0,0.0,0.0); let mut n=0; let seed0: u64 = e("SEED","0").parse().unwrap();
    for r in 0..rounds { let c=cpu_time::ProcessTime::now();
        let (em,vi,sp)= if let Some(t)=&tracer { let s=t.trace(scene.render.vpls as usize, seed0*1000+r as u64); if r==0 {println!("lights {} emitters {} paths {} spacing {}", s.bounced.len(), s.emitters.len(), s.paths, s.spacing);} tc+=c.elapsed().as_secs_f64(); (VirtualTree::new(&s.emitters), VirtualTree::new(&s.bounced), s.spacing*e("K","1").parse::<f32>().unwrap())} else {(VirtualTree::default(),VirtualTree::default(),1.0)};
        frame.set_gathered_lights(GatheredLights::new(&device,[&points,&em,&vi],sp).unwrap()); uc+=c.elapsed().as_secs_f64();
        for _ in 0..16 { gc+=frame.gather(&inputs).unwrap().cpu_ms; n+=1; } }
    let px = (scene.render.size[0]*scene.render.size[1]) as f64;
    println!("trace {:.3}s per round, with tree+upload {:.3}; gather {:.1} CPU ms per frame, {:.2} us per pixel; estimate {:?}", tc/rounds as f64, uc/rounds as f64, gc/n as f64, gc*1e3/n as f64/px, frame.gathered_error().unwrap());
    if let Ok(t)=std::env::var("TRUTH") { let truth=HdrImage::load(&t).unwrap(); let pic= if std::env::var("IND").is_ok() {frame.gathered_light().unwrap().unwrap()[0].clone()} else {frame.hdr().unwrap()};
        let m=truth.pixels.iter().flatten().map(|&v| v as f64).sum::<f64>()/(3.0*truth.pixels.len() as f64);
        let d=|f:&dyn Fn(f64)->f64| pic.pixels.iter().flatten().zip(truth.pixels.iter().flatten()).map(|(&a,&b)| f(a as f64-b as f64)).sum::<f64>()/(3.0*truth.pixels.len() as f64);
        let rmse=d(&|x|x*x).sqrt(); let bias=d(&|x|x); println!("mean {m:.5} bias {:+.4} % rmse {:.3} %  rmse^2*gather_s {:.5}", 100.0*bias/m, 100.0*rmse/m, (rmse/m).powi(2)*(gc/1e3+uc)); }
    if let Ok(o)=std::env::var("OUT") { if std::env::var("IND").is_ok() {frame.gathered_light().unwrap().unwrap()[0].save(&o).unwrap()} else {frame.hdr().unwrap().save(&o).unwrap()}; }
}
#[test] fn run() { main_() }
