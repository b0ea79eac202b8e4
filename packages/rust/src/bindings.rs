// SPDX-License-Identifier: MIT
// Made by packages/rust/bindings from the headers.
use crate::c;

pub const CAROM_NO_FACE: u32 = 65535;
pub const CAROM_LEAF_FACES: u32 = 14;
pub const CAROM_LEAF_VERTICES: u32 = 32;
pub const CAROM_MU_MAX_Q16: u32 = 262144;
pub const CAROM_ROLLING_Q16: u32 = 1024;
pub const CAROM_RAMP_SHADES: u32 = 32;
pub const CAROM_DRAWN_RECTS: u32 = 8;
pub const CAROM_TEXT_WIDTH: u32 = 6;
pub const CAROM_TEXT_HEIGHT: u32 = 9;
pub const CAROM_WORLD: i32 = -1;
extern "C" {
    pub fn carom_version() -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_v3_q22 {
    pub c: [i32; 3usize],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_v3_q24 {
    pub c: [i32; 3usize],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_v3_q30 {
    pub c: [i32; 3usize],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_v3_q32 {
    pub c: [i64; 3usize],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_v3_q40 {
    pub c: [i64; 3usize],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_quat_q30 {
    pub c: [i32; 4usize],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_m3_q30 {
    pub c: [[i32; 3usize]; 3usize],
}
pub const CAROM_SOLID: carom_mesh_kind = 0;
pub const CAROM_SURFACE: carom_mesh_kind = 1;
pub type carom_mesh_kind = c::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_mesh_raw {
    pub vertices: *const [i16; 3usize],
    pub faces: *const [u16; 3usize],
    pub vertex_count: u32,
    pub face_count: u32,
    pub quantum_bits: u8,
    pub kind: u8,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_sym3 {
    pub m: [i32; 6usize],
    pub e: i32,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_mass {
    pub volume_q32: i64,
    pub centre: carom_v3_q22,
    pub inertia: carom_sym3,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_spread {
    pub column: [[i32; 3usize]; 3usize],
    pub e: [i8; 3usize],
    pub reach_bits: i8,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_edge {
    pub vertex: [u16; 2usize],
    pub face: [u16; 2usize],
    pub direction: carom_v3_q30,
    pub length_q22: i32,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_face {
    pub normal: carom_v3_q30,
    pub offset_q22: i32,
    pub edge: [u32; 3usize],
    pub own: u8,
    pub behind: u8,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_leaf {
    pub centre: carom_v3_q22,
    pub radius_q22: i32,
    pub axis: carom_v3_q30,
    pub low_q22: i32,
    pub high_q22: i32,
    pub owned: u32,
    pub first_face: u32,
    pub first_vertex: u32,
    pub face_count: u8,
    pub vertex_count: u8,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_zref {
    pub z0: i16,
    pub z1: i16,
    pub face: u16,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_surface {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_mesh {
    pub raw: carom_mesh_raw,
    pub mass: carom_mass,
    pub inverse: carom_sym3,
    pub inverse_rest: carom_sym3,
    pub spread: carom_spread,
    pub edge_count: u32,
    pub leaf_count: u32,
    pub zref_count: u32,
    pub radius_q22: i32,
    pub box_: [[i16; 3usize]; 2usize],
    pub grid_x0: i32,
    pub grid_y0: i32,
    pub grid_shift: u8,
    pub grid_nx: u8,
    pub grid_ny: u8,
    pub faces: *const carom_face,
    pub edges: *const carom_edge,
    pub ring_start: *const u32,
    pub ring: *const u32,
    pub leaves: *const carom_leaf,
    pub leaf_faces: *const u16,
    pub leaf_vertices: *const u16,
    pub leaf_corners: *const [u8; 3usize],
    pub cell_start: *const u32,
    pub zrefs: *const carom_zref,
    pub surface: *mut carom_surface,
}
extern "C" {
    pub fn carom_mesh_bytes(vertices: u32, faces: u32) -> usize;
}
extern "C" {
    pub fn carom_mesh_check(
        raw: *const carom_mesh_raw,
        scratch: *mut c::c_void,
        bytes: usize,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_mesh_build(
        mesh: *mut carom_mesh,
        raw: *const carom_mesh_raw,
        mem: *mut c::c_void,
        bytes: usize,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_surface_build(
        mesh: *mut carom_mesh,
        raw: *const carom_mesh_raw,
        mem: *mut c::c_void,
        bytes: usize,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_mesh_read(
        raw: *mut carom_mesh_raw,
        blob: *const c::c_void,
        blob_bytes: usize,
        mem: *mut c::c_void,
        bytes: usize,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_caps {
    pub bodies: u32,
    pub pairs: u32,
    pub contacts: u32,
    pub faces: u32,
    pub entries: u32,
    pub candidates: u32,
    pub joints: u32,
    pub extras: u32,
    pub hits: u32,
}
pub const CAROM_POOL_bodies: carom_pool = 0;
pub const CAROM_POOL_pairs: carom_pool = 1;
pub const CAROM_POOL_contacts: carom_pool = 2;
pub const CAROM_POOL_faces: carom_pool = 3;
pub const CAROM_POOL_entries: carom_pool = 4;
pub const CAROM_POOL_candidates: carom_pool = 5;
pub const CAROM_POOL_joints: carom_pool = 6;
pub const CAROM_POOL_extras: carom_pool = 7;
pub const CAROM_POOL_hits: carom_pool = 8;
pub const CAROM_POOL_COUNT: carom_pool = 9;
pub type carom_pool = c::c_uint;
extern "C" {
    pub fn carom_world_bytes(caps: *const carom_caps) -> usize;
}
pub const CAROM_OK: carom_status = 0;
pub const CAROM_OVER_BUDGET: carom_status = 1;
pub const CAROM_SUBSTEP_CAP: carom_status = 2;
pub type carom_status = c::c_uint;
pub const CAROM_ERR_NULL: carom_error = -1;
pub const CAROM_ERR_ARGUMENT: carom_error = -2;
pub const CAROM_ERR_RANGE: carom_error = -3;
pub const CAROM_ERR_MEMORY: carom_error = -4;
pub const CAROM_ERR_BODY: carom_error = -5;
pub const CAROM_ERR_BODIES_FULL: carom_error = -6;
pub const CAROM_ERR_PAIRS_FULL: carom_error = -7;
pub const CAROM_ERR_CONTACTS_FULL: carom_error = -8;
pub const CAROM_ERR_FACES_FULL: carom_error = -9;
pub const CAROM_ERR_MESH_EMPTY: carom_error = -10;
pub const CAROM_ERR_MESH_SIZE: carom_error = -11;
pub const CAROM_ERR_MESH_INDEX: carom_error = -12;
pub const CAROM_ERR_MESH_DEGENERATE: carom_error = -13;
pub const CAROM_ERR_MESH_OPEN: carom_error = -14;
pub const CAROM_ERR_MESH_EDGE: carom_error = -15;
pub const CAROM_ERR_MESH_INSIDE_OUT: carom_error = -16;
pub const CAROM_ERR_MESH_SURFACE: carom_error = -17;
pub const CAROM_ERR_FORMAT: carom_error = -18;
pub const CAROM_ERR_BLOCKED: carom_error = -19;
pub const CAROM_ERR_NO_ENTRIES: carom_error = -20;
pub const CAROM_ERR_EXTRAS_FULL: carom_error = -21;
pub const CAROM_ERR_OVERLAP: carom_error = -22;
pub const CAROM_ERR_JOINT: carom_error = -23;
pub const CAROM_ERR_JOINTS_FULL: carom_error = -24;
pub type carom_error = c::c_int;
extern "C" {
    pub fn carom_result_text(result: c::c_int) -> *const c::c_char;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_world {
    _unused: [u8; 0],
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_touch {
    pub a: u16,
    pub b: u16,
    pub face_a: u16,
    pub face_b: u16,
    pub point: carom_v3_q32,
    pub normal: carom_v3_q30,
    pub speed_q40: i64,
    pub restitution_q30: i32,
    pub friction_q16: u32,
}
pub type carom_contact_function = ::core::option::Option<
    unsafe extern "C" fn(user: *mut c::c_void, touch: *mut carom_touch) -> bool,
>;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_config {
    pub caps: carom_caps,
    pub gravity: carom_v3_q40,
    pub sleep: bool,
    pub substep_cap: u8,
    pub sweep_cap: u8,
    pub ticks: ::core::option::Option<unsafe extern "C" fn() -> u32>,
    pub budget_ticks: u32,
    pub contact: carom_contact_function,
    pub contact_user: *mut c::c_void,
}
extern "C" {
    pub fn carom_world_init(
        mem: *mut c::c_void,
        bytes: usize,
        config: *const carom_config,
        world: *mut *mut carom_world,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_world_set_gravity(
        world: *mut carom_world,
        gravity: *const carom_v3_q40,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_filter {
    pub category: u16,
    pub mask: u16,
    pub group: i16,
}
pub const CAROM_BOTH_WAYS: carom_one_way = 0;
pub const CAROM_ONE_WAY_X: carom_one_way = 1;
pub const CAROM_ONE_WAY_Y: carom_one_way = 2;
pub const CAROM_ONE_WAY_Z: carom_one_way = 3;
pub const CAROM_ONE_WAY_MINUS_X: carom_one_way = 4;
pub const CAROM_ONE_WAY_MINUS_Y: carom_one_way = 5;
pub const CAROM_ONE_WAY_MINUS_Z: carom_one_way = 6;
pub type carom_one_way = c::c_uint;
pub const CAROM_OVERLAP_REFUSE: carom_overlap = 0;
pub const CAROM_OVERLAP_PUSH_OUT: carom_overlap = 1;
pub const CAROM_OVERLAP_PASS: carom_overlap = 2;
pub type carom_overlap = c::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_body_def {
    pub mesh: *const carom_mesh,
    pub stationary: bool,
    pub kinematic: bool,
    pub position: carom_v3_q32,
    pub rotation: carom_quat_q30,
    pub velocity: carom_v3_q40,
    pub spin: carom_v3_q40,
    pub mass_q20: u32,
    pub restitution_q30: i32,
    pub friction_q16: u32,
    pub filter: carom_filter,
    pub sensor: bool,
    pub one_way: u8,
    pub overlap: u8,
    pub user: *mut c::c_void,
}
extern "C" {
    pub fn carom_body_add(world: *mut carom_world, def: *const carom_body_def) -> c::c_int;
}
extern "C" {
    pub fn carom_body_remove(world: *mut carom_world, body: c::c_int) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_body_state {
    pub position: carom_v3_q32,
    pub rotation: carom_quat_q30,
    pub velocity: carom_v3_q40,
    pub spin: carom_v3_q40,
    pub asleep: bool,
    pub out: bool,
    pub overlap: u8,
}
extern "C" {
    pub fn carom_body_get(
        world: *const carom_world,
        body: c::c_int,
        state: *mut carom_body_state,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_body_look {
    pub mesh: *const carom_mesh,
    pub position: carom_v3_q32,
    pub rotation: carom_quat_q30,
    pub moving: bool,
}
extern "C" {
    pub fn carom_body_look(
        world: *const carom_world,
        body: c::c_int,
        look: *mut carom_body_look,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_mesh(world: *const carom_world, body: c::c_int) -> *const carom_mesh;
}
extern "C" {
    pub fn carom_body_count(world: *const carom_world) -> c::c_int;
}
extern "C" {
    pub fn carom_body_set(
        world: *mut carom_world,
        body: c::c_int,
        state: *const carom_body_state,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_pose {
    pub position: carom_v3_q32,
    pub rotation: carom_quat_q30,
}
extern "C" {
    pub fn carom_body_move_to(
        world: *mut carom_world,
        body: c::c_int,
        pose: *const carom_pose,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_set_filter(
        world: *mut carom_world,
        body: c::c_int,
        filter: *const carom_filter,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_get_filter(
        world: *const carom_world,
        body: c::c_int,
        filter: *mut carom_filter,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_set_force(
        world: *mut carom_world,
        body: c::c_int,
        force: *const carom_v3_q40,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_push(
        world: *mut carom_world,
        body: c::c_int,
        impulse: *const carom_v3_q40,
        point: *const carom_v3_q32,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_surface_move(
        world: *mut carom_world,
        body: c::c_int,
        vertices: *const [i16; 3usize],
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_surface_set(
        world: *mut carom_world,
        body: c::c_int,
        vertices: *const [i16; 3usize],
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_world_step(world: *mut carom_world) -> c::c_int;
}
pub const CAROM_EVENT_BEGIN: carom_event_kind = 0;
pub const CAROM_EVENT_HIT: carom_event_kind = 1;
pub const CAROM_EVENT_END: carom_event_kind = 2;
pub const CAROM_EVENT_REST: carom_event_kind = 3;
pub const CAROM_EVENT_OUT: carom_event_kind = 4;
pub const CAROM_EVENT_WAKE: carom_event_kind = 5;
pub const CAROM_EVENT_CUT: carom_event_kind = 6;
pub const CAROM_EVENT_SENSOR_BEGIN: carom_event_kind = 7;
pub const CAROM_EVENT_SENSOR_END: carom_event_kind = 8;
pub const CAROM_EVENT_BREAK: carom_event_kind = 9;
pub const CAROM_EVENT_BLOCKED: carom_event_kind = 10;
pub type carom_event_kind = c::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_event {
    pub kind: u8,
    pub a: u16,
    pub b: u16,
    pub details: u16,
    pub speed_q40: i64,
    pub impulse_q40: i64,
}
extern "C" {
    pub fn carom_events(world: *const carom_world, events: *mut *const carom_event) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_hit {
    pub point: carom_v3_q32,
    pub normal: carom_v3_q30,
    pub face_a: u16,
    pub face_b: u16,
}
extern "C" {
    pub fn carom_event_hit(
        world: *const carom_world,
        event: *const carom_event,
        hit: *mut carom_hit,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_face_ref {
    pub body: u16,
    pub face: u16,
}
extern "C" {
    pub fn carom_interfering_faces(
        world: *const carom_world,
        faces: *mut *const carom_face_ref,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_contact {
    pub point: carom_v3_q32,
    pub normal: carom_v3_q30,
    pub gap_q22: i32,
    pub impulse_q40: i64,
    pub a: u16,
    pub b: u16,
}
extern "C" {
    pub fn carom_contacts(
        world: *const carom_world,
        contacts: *mut carom_contact,
        max: c::c_int,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_face_pair {
    pub a: u16,
    pub b: u16,
}
extern "C" {
    pub fn carom_query_faces(
        world: *mut carom_world,
        a: c::c_int,
        b: c::c_int,
        out: *mut carom_face_pair,
        room: u32,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_query_inside(world: *const carom_world, a: c::c_int, b: c::c_int) -> c::c_int;
}
pub const CAROM_STAGE_PREDICT: carom_stage = 0;
pub const CAROM_STAGE_BROAD: carom_stage = 1;
pub const CAROM_STAGE_INTERFERE: carom_stage = 2;
pub const CAROM_STAGE_BOYSE: carom_stage = 3;
pub const CAROM_STAGE_CONTACT: carom_stage = 4;
pub const CAROM_STAGE_IMPACT: carom_stage = 5;
pub const CAROM_STAGE_REST: carom_stage = 6;
pub const CAROM_STAGE_ADVANCE: carom_stage = 7;
pub const CAROM_STAGE_COMMIT: carom_stage = 8;
pub const CAROM_STAGE_COUNT: carom_stage = 9;
pub type carom_stage = c::c_uint;
extern "C" {
    pub fn carom_stage_name(stage: c::c_int) -> *const c::c_char;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_stats {
    pub ticks: [u32; 9usize],
    pub total_ticks: u32,
    pub over_stage: u32,
    pub substeps: u32,
    pub hits: u32,
    pub gathers: u32,
    pub refinements: u32,
    pub candidates: u32,
    pub roots: u32,
    pub contacts: u32,
    pub sweeps: u32,
    pub impacts: u32,
    pub energy_rule: u32,
    pub cut_islands: u32,
    pub calmed: u32,
}
extern "C" {
    pub fn carom_stats(world: *const carom_world, stats: *mut carom_stats) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_usage {
    pub name: *const c::c_char,
    pub size: u32,
    pub used: u32,
    pub peak: u32,
    pub refused: u32,
}
extern "C" {
    pub fn carom_usage(world: *const carom_world, usage: *mut carom_usage) -> c::c_int;
}
extern "C" {
    pub fn carom_world_hash(world: *const carom_world) -> u64;
}
extern "C" {
    pub fn carom_snapshot_size(world: *const carom_world) -> c::c_int;
}
extern "C" {
    pub fn carom_snapshot_save(
        world: *const carom_world,
        out: *mut c::c_void,
        bytes: usize,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_snapshot_load(
        world: *mut carom_world,
        in_: *const c::c_void,
        bytes: usize,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_id(world: *const carom_world, body: c::c_int) -> c::c_int;
}
extern "C" {
    pub fn carom_body_number(id: c::c_int) -> c::c_int;
}
extern "C" {
    pub fn carom_body_set_user(
        world: *mut carom_world,
        body: c::c_int,
        user: *mut c::c_void,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_user(world: *const carom_world, body: c::c_int) -> *mut c::c_void;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_matrix {
    pub r: carom_m3_q30,
    pub origin: carom_v3_q32,
}
extern "C" {
    pub fn carom_body_matrix(
        world: *const carom_world,
        body: c::c_int,
        matrix: *mut carom_matrix,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_world_point(
        world: *const carom_world,
        body: c::c_int,
        local: *const carom_v3_q32,
        point: *mut carom_v3_q32,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_local_point(
        world: *const carom_world,
        body: c::c_int,
        point: *const carom_v3_q32,
        local: *mut carom_v3_q32,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_world_vector(
        world: *const carom_world,
        body: c::c_int,
        vector: *const i64,
        out: *mut i64,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_local_vector(
        world: *const carom_world,
        body: c::c_int,
        vector: *const i64,
        out: *mut i64,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_velocity_at(
        world: *const carom_world,
        body: c::c_int,
        point: *const carom_v3_q32,
        velocity: *mut carom_v3_q40,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_material {
    pub restitution_q30: i32,
    pub friction_q16: u32,
    pub rolling_q16: u32,
    pub surface_velocity: carom_v3_q40,
}
extern "C" {
    pub fn carom_body_set_material(
        world: *mut carom_world,
        body: c::c_int,
        material: *const carom_material,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_material(
        world: *const carom_world,
        body: c::c_int,
        material: *mut carom_material,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_set_face_materials(
        world: *mut carom_world,
        body: c::c_int,
        materials: *const carom_material,
        count: u32,
        of_face: *const u8,
    ) -> c::c_int;
}
pub const CAROM_SMALLER: carom_combine = 0;
pub const CAROM_LARGER: carom_combine = 1;
pub const CAROM_PRODUCT: carom_combine = 2;
pub const CAROM_MEAN: carom_combine = 3;
pub type carom_combine = c::c_uint;
extern "C" {
    pub fn carom_world_set_combine(
        world: *mut carom_world,
        restitution: carom_combine,
        friction: carom_combine,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_set_mass(world: *mut carom_world, body: c::c_int, mass_q20: u32) -> c::c_int;
}
extern "C" {
    pub fn carom_body_mass(
        world: *const carom_world,
        body: c::c_int,
        mass_q20: *mut u32,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_forces {
    pub force: carom_v3_q40,
    pub torque: carom_v3_q40,
    pub gravity_scale_q16: i32,
    pub linear_damping_q30: i32,
    pub angular_damping_q30: i32,
}
extern "C" {
    pub fn carom_body_forces(
        world: *const carom_world,
        body: c::c_int,
        forces: *mut carom_forces,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_set_force_at(
        world: *mut carom_world,
        body: c::c_int,
        force: *const carom_v3_q40,
        point: *const carom_v3_q32,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_set_torque(
        world: *mut carom_world,
        body: c::c_int,
        torque: *const carom_v3_q40,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_set_gravity_scale(
        world: *mut carom_world,
        body: c::c_int,
        scale_q16: i32,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_set_damping(
        world: *mut carom_world,
        body: c::c_int,
        linear_q30: i32,
        angular_q30: i32,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_push_centre(
        world: *mut carom_world,
        body: c::c_int,
        impulse: *const carom_v3_q40,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_body_twist(
        world: *mut carom_world,
        body: c::c_int,
        angular: *const carom_v3_q40,
    ) -> c::c_int;
}
pub const CAROM_QUERY_BACK: carom_query_flags = 1;
pub const CAROM_QUERY_SENSORS: carom_query_flags = 2;
pub type carom_query_flags = c::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_query_filter {
    pub mask: u16,
    pub flags: u16,
    pub wants: ::core::option::Option<
        unsafe extern "C" fn(context: *mut c::c_void, body: c::c_int) -> bool,
    >,
    pub context: *mut c::c_void,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_ray {
    pub from: carom_v3_q32,
    pub way: carom_v3_q32,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_ray_hit {
    pub body: u16,
    pub face: u16,
    pub t_q30: i32,
    pub t_rest: u32,
    pub point: carom_v3_q32,
    pub normal: carom_v3_q30,
}
extern "C" {
    pub fn carom_cast_ray(
        world: *const carom_world,
        ray: *const carom_ray,
        filter: *const carom_query_filter,
        hit: *mut carom_ray_hit,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_cast_ray_all(
        world: *const carom_world,
        ray: *const carom_ray,
        filter: *const carom_query_filter,
        hits: *mut carom_ray_hit,
        room: u32,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_query_mesh {
    pub mesh: *const carom_mesh,
    pub position: carom_v3_q32,
    pub rotation: carom_quat_q30,
}
extern "C" {
    pub fn carom_overlap_mesh(
        world: *mut carom_world,
        mesh: *const carom_query_mesh,
        filter: *const carom_query_filter,
        bodies: *mut u16,
        room: u32,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_mesh_way {
    pub way: carom_v3_q32,
    pub turn: carom_v3_q30,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_mesh_hit {
    pub body: u16,
    pub face: u16,
    pub own_face: u16,
    pub t_q30: i32,
    pub position: carom_v3_q32,
    pub rotation: carom_quat_q30,
    pub point: carom_v3_q32,
    pub normal: carom_v3_q30,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_cast_workspace {
    pub words: [u64; 396usize],
}
extern "C" {
    pub fn carom_cast_mesh(
        world: *mut carom_world,
        mesh: *const carom_query_mesh,
        way: *const carom_mesh_way,
        filter: *const carom_query_filter,
        workspace: *mut carom_cast_workspace,
        hit: *mut carom_mesh_hit,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_closest {
    pub distance_q32: i64,
    pub point: [carom_v3_q32; 2usize],
    pub normal: carom_v3_q30,
    pub face: [u16; 2usize],
}
extern "C" {
    pub fn carom_closest_points(
        world: *mut carom_world,
        a: c::c_int,
        b: c::c_int,
        out: *mut carom_closest,
    ) -> c::c_int;
}
pub const CAROM_DRAW_FLAT: carom_draw_style = 0;
pub const CAROM_DRAW_WIRE: carom_draw_style = 1;
pub type carom_draw_style = c::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_camera {
    pub eye: carom_v3_q32,
    pub target: carom_v3_q32,
    pub focal_q16: i32,
}
pub const CAROM_PALETTE8: carom_pixel_format = 0;
pub const CAROM_RGB565: carom_pixel_format = 1;
pub const CAROM_XRGB8888: carom_pixel_format = 2;
pub const CAROM_GREY4: carom_pixel_format = 3;
pub const CAROM_BGR555: carom_pixel_format = 4;
pub type carom_pixel_format = c::c_uint;
pub const CAROM_RAMP_BACKGROUND: carom_ramp = 0;
pub const CAROM_RAMP_STATIONARY: carom_ramp = 1;
pub const CAROM_RAMP_MOVING: carom_ramp = 2;
pub const CAROM_RAMP_STATIONARY_HOT: carom_ramp = 3;
pub const CAROM_RAMP_MOVING_HOT: carom_ramp = 4;
pub const CAROM_RAMP_BLUE: carom_ramp = 5;
pub const CAROM_RAMP_VIOLET: carom_ramp = 6;
pub type carom_ramp = c::c_uint;
pub const CAROM_COLOUR_BLACK: carom_colour = 248;
pub const CAROM_COLOUR_RED: carom_colour = 249;
pub const CAROM_COLOUR_GREEN: carom_colour = 250;
pub const CAROM_COLOUR_BLUE: carom_colour = 251;
pub const CAROM_COLOUR_YELLOW: carom_colour = 252;
pub const CAROM_COLOUR_MAGENTA: carom_colour = 253;
pub const CAROM_COLOUR_CYAN: carom_colour = 254;
pub const CAROM_COLOUR_WHITE: carom_colour = 255;
pub type carom_colour = c::c_uint;
extern "C" {
    pub static carom_draw_palette: [u32; 256usize];
}
extern "C" {
    pub fn carom_draw_ramp(ramp: *mut u32, rgb: u32) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_body_paint {
    pub faces: *const u8,
    pub ramp: u8,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_paint_line {
    pub from: carom_v3_q32,
    pub to: carom_v3_q32,
    pub colour: u16,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_shadows {
    _unused: [u8; 0],
}
extern "C" {
    pub static carom_shadows: carom_shadows;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_smooth {
    _unused: [u8; 0],
}
extern "C" {
    pub static carom_smooth: carom_smooth;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_paint {
    pub palette: *const u32,
    pub ramps: u32,
    pub bodies: *const carom_body_paint,
    pub body_count: u32,
    pub hide_interfering: bool,
    pub interfering_ramp: u8,
    pub light: carom_v3_q30,
    pub ambient_q30: i32,
    pub horizon: bool,
    pub shadows: *const carom_shadows,
    pub smooth: *const carom_smooth,
    pub crease_q30: i32,
    pub lines: *const carom_paint_line,
    pub line_count: u32,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_picture {
    pub pixels: *mut c::c_void,
    pub width: i32,
    pub height: i32,
    pub stride: i32,
    pub format: u8,
    pub workspace: *mut c::c_void,
    pub workspace_bytes: usize,
    pub row: ::core::option::Option<
        unsafe extern "C" fn(context: *mut c::c_void, x0: i32, x1: i32, y: i32) -> *mut c::c_void,
    >,
    pub context: *mut c::c_void,
    pub paint: *const carom_paint,
}
extern "C" {
    pub fn carom_draw(
        world: *const carom_world,
        camera: *const carom_camera,
        picture: *const carom_picture,
        style: carom_draw_style,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_rect {
    pub x0: i16,
    pub y0: i16,
    pub x1: i16,
    pub y1: i16,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_drawn_body {
    pub look: carom_body_look,
    pub moves: u32,
    pub all: carom_rect,
    pub hot: carom_rect,
    pub ramp: u8,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_drawn {
    pub bodies: *mut carom_drawn_body,
    pub room: u32,
    pub touched: carom_rect,
    pub changed: [carom_rect; 8usize],
    pub changed_count: c::c_int,
    pub shows: bool,
    pub style: u8,
    pub count: u32,
    pub camera: carom_camera,
    pub picture: carom_picture,
    pub paint: carom_paint,
    pub lines: carom_rect,
    pub lines_hash: u64,
}
extern "C" {
    pub fn carom_draw_changes(
        world: *const carom_world,
        camera: *const carom_camera,
        picture: *const carom_picture,
        style: carom_draw_style,
        drawn: *mut carom_drawn,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_view_ray(
        camera: *const carom_camera,
        width: i32,
        height: i32,
        x_q8: i32,
        y_q8: i32,
        ray: *mut carom_ray,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_draw_pick(
        world: *const carom_world,
        camera: *const carom_camera,
        picture: *const carom_picture,
        x: i32,
        y: i32,
        filter: *const carom_query_filter,
        hit: *mut carom_ray_hit,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_draw_line(
        camera: *const carom_camera,
        picture: *const carom_picture,
        from: *const carom_v3_q32,
        to: *const carom_v3_q32,
        colour: u32,
        touched: *mut carom_rect,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_text {
    pub x: i32,
    pub y: i32,
    pub scale: u8,
    pub opaque: bool,
    pub colour: u16,
    pub paper: u16,
}
extern "C" {
    pub fn carom_draw_text(
        picture: *const carom_picture,
        where_: *const carom_text,
        text: *const c::c_char,
        touched: *mut carom_rect,
    ) -> c::c_int;
}
pub const CAROM_DEBUG_FACES: carom_debug_flag = 1;
pub const CAROM_DEBUG_INTERFERING: carom_debug_flag = 2;
pub const CAROM_DEBUG_EDGES: carom_debug_flag = 4;
pub const CAROM_DEBUG_BOXES: carom_debug_flag = 8;
pub const CAROM_DEBUG_AXES: carom_debug_flag = 16;
pub const CAROM_DEBUG_VELOCITIES: carom_debug_flag = 32;
pub const CAROM_DEBUG_CONTACTS: carom_debug_flag = 64;
pub const CAROM_DEBUG_JOINTS: carom_debug_flag = 128;
pub type carom_debug_flag = c::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_debug {
    pub triangle: ::core::option::Option<
        unsafe extern "C" fn(
            context: *mut c::c_void,
            corner: *const carom_v3_q32,
            normal: *const carom_v3_q30,
            colour: u32,
        ),
    >,
    pub line: ::core::option::Option<
        unsafe extern "C" fn(
            context: *mut c::c_void,
            from: *const carom_v3_q32,
            to: *const carom_v3_q32,
            colour: u32,
        ),
    >,
    pub point: ::core::option::Option<
        unsafe extern "C" fn(context: *mut c::c_void, at: *const carom_v3_q32, colour: u32),
    >,
    pub context: *mut c::c_void,
    pub paint: *const carom_paint,
    pub size_q32: i64,
    pub contacts: *mut carom_contact,
    pub contact_room: c::c_int,
}
extern "C" {
    pub fn carom_debug_draw(
        world: *const carom_world,
        flags: u32,
        debug: *const carom_debug,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_debug_lines {
    pub lines: *mut carom_paint_line,
    pub room: u32,
    pub count: u32,
    pub lost: u32,
}
extern "C" {
    pub fn carom_debug_keep_line(
        lines: *mut c::c_void,
        from: *const carom_v3_q32,
        to: *const carom_v3_q32,
        colour: u32,
    );
}
pub const CAROM_JOINT_BALL: carom_joint_kind = 0;
pub const CAROM_JOINT_HINGE: carom_joint_kind = 1;
pub const CAROM_JOINT_SLIDER: carom_joint_kind = 2;
pub const CAROM_JOINT_DISTANCE: carom_joint_kind = 3;
pub const CAROM_JOINT_FIXED: carom_joint_kind = 4;
pub type carom_joint_kind = c::c_uint;
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_joint_drive {
    pub limited: bool,
    pub lower_q32: i64,
    pub upper_q32: i64,
    pub motor: bool,
    pub motor_speed_q40: i64,
    pub motor_most_q40: i64,
    pub spring: bool,
    pub rest_q32: i64,
    pub stiffness_q40: i64,
    pub damping_q40: i64,
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_joint_def {
    pub kind: u8,
    pub touch: bool,
    pub a: c::c_int,
    pub b: c::c_int,
    pub anchor: carom_v3_q32,
    pub anchor_b: carom_v3_q32,
    pub axis: carom_v3_q30,
    pub drive: carom_joint_drive,
    pub most_impulse_q40: i64,
}
extern "C" {
    pub fn carom_joint_add(world: *mut carom_world, def: *const carom_joint_def) -> c::c_int;
}
extern "C" {
    pub fn carom_joint_remove(world: *mut carom_world, joint: c::c_int) -> c::c_int;
}
extern "C" {
    pub fn carom_joint_set(
        world: *mut carom_world,
        joint: c::c_int,
        drive: *const carom_joint_drive,
    ) -> c::c_int;
}
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct carom_joint_state {
    pub kind: u8,
    pub broken: bool,
    pub a: c::c_int,
    pub b: c::c_int,
    pub anchor: [carom_v3_q32; 2usize],
    pub axis: carom_v3_q30,
    pub coordinate_q32: i64,
    pub speed_q40: i64,
    pub impulse: carom_v3_q40,
    pub moment: carom_v3_q40,
    pub drive_q40: i64,
    pub drive: carom_joint_drive,
}
extern "C" {
    pub fn carom_joint_get(
        world: *const carom_world,
        joint: c::c_int,
        state: *mut carom_joint_state,
    ) -> c::c_int;
}
extern "C" {
    pub fn carom_joint_count(world: *const carom_world) -> c::c_int;
}
