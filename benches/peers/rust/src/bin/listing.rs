//! Prints the programs of an arm as JSON, for another tool to rebuild them operation by operation.
//!
//! `methods` are the programs that code is emitted from. `jacobians` are the Jacobian together with M, in every frame
//! that w_D may take it from: in the axes of the frame itself, and, by way of the frame, in world axes.

use serde_json::{Value, json};
use ulna_codegen::internal::{
    Chain, Graph, Twist, jacobian_in_group, jacobian_in_world, mass_matrix, schedule,
};
use ulna_codegen::{Input, Operand, Output, Program};
use ulna_table::Model;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let table = std::env::args().nth(1).ok_or("usage: listing TABLE")?;
    let model = Model::load(table)?;
    let methods: serde_json::Map<String, Value> = ulna_codegen::compile(&model)
        .methods
        .iter()
        .map(|method| (method.method.name().into(), listing(&method.program)))
        .collect();
    let groups = Chain::new(&Graph::new(), &model).groups.len();
    let in_every_frame = |jacobian: JacobianIn| -> Vec<Value> {
        let frames = 0..=groups;
        frames
            .map(|frame| listing(&with_mass(&model, jacobian, frame)))
            .collect()
    };
    let all = json!({
        "methods": methods,
        "jacobians": { "own": in_every_frame(jacobian_in_group), "world": in_every_frame(jacobian_in_world) },
    });
    println!("{all}");
    Ok(())
}

type JacobianIn = for<'g> fn(&Chain<'g>, usize) -> Vec<Twist<'g>>;

fn with_mass(model: &Model, jacobian: JacobianIn, frame: usize) -> Program {
    let graph = Graph::new();
    let chain = Chain::new(&graph, model);
    let n = chain.joint_count();
    let columns = jacobian(&chain, frame);
    let twists = columns.iter().flat_map(|twist| twist.components());
    let jacobian = Output::new("jacobian", &[n, 6], twists.collect());
    let mass = Output::new("mass", &[n, n], mass_matrix(&chain).concat());
    schedule(&graph, &[jacobian, mass])
}

fn listing(program: &Program) -> Value {
    let angles = program.angles.iter();
    let steps = program.steps.iter();
    let outputs = program.outputs.iter();
    json!({
        "angles": angles.map(|a| json!({"joints": a.joints, "offset": a.offset.to_f64()})).collect::<Vec<_>>(),
        "steps": steps.map(|s| json!([s.op.row().name, operand(s.a), operand(s.b)])).collect::<Vec<_>>(),
        "outputs": outputs.map(|o| json!({
            "name": o.name,
            "elements": o.elements.iter().copied().map(operand).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
    })
}

fn operand(operand: Operand) -> Value {
    match operand {
        Operand::Constant(value) => json!(["number", value.to_f64()]),
        Operand::Step(step) => json!(["step", step]),
        Operand::Input(Input::Q(i)) => json!(["q", i]),
        Operand::Input(Input::Sin(angle)) => json!(["sin", angle]),
        Operand::Input(Input::Cos(angle)) => json!(["cos", angle]),
        Operand::Input(Input::Qd(i)) => json!(["qd", i]),
        Operand::Input(Input::Qdd(i)) => json!(["qdd", i]),
        Operand::Input(Input::Tau(i)) => json!(["tau", i]),
        Operand::Input(Input::Wrench(i)) => json!(["wrench", i]),
        Operand::Input(Input::Payload(i)) => json!(["payload", i]),
    }
}
