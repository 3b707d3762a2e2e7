//! What the families of [names](crate::label) mean, for the docs of generated kernels.

/// Each family, what its names look like, and their meaning. Joints, their links and the task's rows are counted from 1.
/// A link's quantities are in the axes of the last frame among its neighbours about parallel axes (its own, if there are none),
/// and about its joint's origin.
const LEGEND: &[(&str, &str, &str)] = &[
    // Kinematics.
    (
        "r",
        "rx_i, ry_i, rz_i",
        "from joint i's origin to the tool point, m",
    ),
    (
        "o",
        "ox_i, oy_i, oz_i",
        "from the origin of joint i - 1 to that of joint i, m",
    ),
    (
        "axes",
        "rk_i_j, rkx_i_j",
        "rotation from the k-th group of parallel joints to the world; the same before the group's own turn",
    ),
    (
        "pose",
        "r_i_j, p_x, p_y, p_z",
        "the tool's rotation, and its place, m",
    ),
    (
        "j",
        "j_x_i ... j_rz_i",
        "column i of J: rows x, y, z (velocity) and rx, ry, rz (angular velocity)",
    ),
    (
        "jt",
        "jt_x_i ... jt_rz_i",
        "column i of J in other axes, in which w_D is the same and costs less",
    ),
    ("dj", "dj_i_x_j ... dj_i_rz_j", "∂/∂q_i of column j of J"),
    ("jd", "jd_x_i ... jd_rz_i", "column i of J̇"),
    (
        "jl",
        "jl_i_x_j ... jl_i_rz_j",
        "column j of the Jacobian of link i, at its frame's origin",
    ),
    (
        "link_axes",
        "rx_i_j, ry_i_j, rz_i_j",
        "axis j of the frame of link i, in world axes",
    ),
    (
        "origin",
        "px_i, py_i, pz_i",
        "origin of the frame of link i, m, in world axes",
    ),
    (
        "o_world",
        "ox_i_w, oy_i_w, oz_i_w",
        "from the origin of link i - 1 to that of link i, m, in world axes",
    ),
    ("jdqd", "jdqd_x ... jdqd_rz", "entry of J̇ q̇"),
    (
        "vt",
        "vtx_i, vty_i, vtz_i",
        "velocity of the tool point as link i sees it, m/s",
    ),
    (
        "wt",
        "wtx_i, wty_i, wtz_i",
        "angular velocity of the tool as link i sees it, rad/s",
    ),
    (
        "at",
        "atx_i, aty_i, atz_i",
        "acceleration of the tool point as link i sees it, m/s²",
    ),
    (
        "alt",
        "altx_i, alty_i, altz_i",
        "angular acceleration of the tool as link i sees it, rad/s²",
    ),
    (
        "vj",
        "vjx_i ...",
        "velocity of the tool point as link i - 1 sees it, m/s, in the axes of link i",
    ),
    (
        "wj",
        "wjx_i ...",
        "angular velocity of the tool as link i - 1 sees it, rad/s, in the axes of link i",
    ),
    (
        "aj",
        "ajx_i ...",
        "acceleration of the tool point as link i - 1 sees it, m/s², in the axes of link i",
    ),
    (
        "alj",
        "aljx_i ...",
        "angular acceleration of the tool as link i - 1 sees it, rad/s², in the axes of link i",
    ),
    (
        "given",
        "vx_by_i, vy_by_i, vz_by_i",
        "velocity that joint i gives the tool point, m/s",
    ),
    (
        "c",
        "cx_i, cy_i, cz_i",
        "first moment of the links from i on over the mass of all, m",
    ),
    (
        "com",
        "c_x, c_y, c_z",
        "the centre of mass, m, in world axes",
    ),
    (
        "mmc",
        "mmcx_i, mmcy_i, mmcz_i",
        "minus the first moment of the links from i on, kg·m",
    ),
    // Inertia.
    (
        "own",
        "mcx_i ..., ixx_i ...",
        "first moment (kg·m) and inertia (kg·m²) of link i",
    ),
    (
        "from",
        "mcx_from_i ..., ixx_from_i ...",
        "first moment and inertia of all links from i on, as one body",
    ),
    (
        "turned",
        "mcx_from_i_z ..., mcx_from_i_zx ...",
        "those about the point of joint i's axis that is nearest to the axis before, turned about z by the joint's angle, and then about x \
         into the axes of the link before",
    ),
    (
        "p",
        "px_i_j, py_i_j, pz_i_j",
        "momentum, at joint i, of the links from j on at unit speed of joint j",
    ),
    (
        "l",
        "lx_i_j, ly_i_j, lz_i_j",
        "angular momentum, at joint i, of the links from j on at unit speed of joint j",
    ),
    ("m", "m_i_j", "entry of the mass matrix M"),
    ("m_inv", "m_inv_i_j", "entry of M⁻¹"),
    ("d", "d_i", "pivot: entry of D in M = U D Uᵀ"),
    (
        "d_inv",
        "d_inv_i",
        "1 / d_i, d_i the pivots: entries of D in M = U D Uᵀ",
    ),
    ("u", "u_i_j", "entry of U in M = U D Uᵀ"),
    ("ud", "ud_i_j", "entry of U D"),
    (
        "schur",
        "schur_i_j_k",
        "`m_i_j` less what the pivots from k on take off it",
    ),
    ("v", "v_i_j", "entry of V = U⁻¹"),
    ("v_over_d", "v_over_d_i_j", "`v_i_j` / `d_i`"),
    (
        "articulated",
        "aaxx_i ..., acxy_i ..., aixx_i ...",
        "articulated inertia at joint i: linear, mixed and angular part",
    ),
    // Derivatives of M.
    ("dm", "dm_i_j_k", "∂/∂q_i of `m_j_k`"),
    (
        "twist",
        "vx_k_at_i ..., wx_k_at_i ...",
        "velocity and angular velocity at joint i's origin at unit speed of joint k",
    ),
    (
        "rate",
        "mcx_rate_i ..., ixx_rate_i ...",
        "rate of change of the links from i on, as one body, at unit speed of joint i",
    ),
    (
        "dp",
        "dpx_i_j ...",
        "momentum by that rate of change at unit speed of joint j",
    ),
    (
        "dl",
        "dlx_i_j ...",
        "angular momentum by that rate of change at unit speed of joint j",
    ),
    ("hqd", "hqd_i", "half of q̇_i"),
    (
        "chr2",
        "chr2_i_j_k",
        "twice Christoffel's symbol c_ijk: ∂M_ij/∂q_k + ∂M_ik/∂q_j − ∂M_jk/∂q_i",
    ),
    (
        "sym",
        "sym_i_j",
        "terms that the entries (i, j) and (j, i) of C have in common",
    ),
    (
        "skew",
        "skew_i_j",
        "terms of entry (i, j) of C that (j, i) has with the other sign",
    ),
    ("cor", "cor_i_j", "entry of the Coriolis matrix C"),
    // Dynamics.
    (
        "omega",
        "wx_i, wy_i, wz_i",
        "angular velocity of link i, rad/s",
    ),
    (
        "al",
        "alx_i, aly_i, alz_i",
        "angular acceleration of link i, rad/s²",
    ),
    (
        "a",
        "ax_i, ay_i, az_i",
        "acceleration of joint i's origin less gravity, m/s²",
    ),
    (
        "ww",
        "ww_xy_i ...",
        "product of two components of the angular velocity of link i",
    ),
    (
        "lam",
        "lam_xy_i ...",
        "`[α]× + [ω]×[ω]×` of link i: what its turning gives a vector fixed in it",
    ),
    (
        "own_wrench",
        "fx_own_i ..., nx_own_i ...",
        "force and moment that link i's own motion takes, N and N·m",
    ),
    (
        "f",
        "fx_i, fy_i, fz_i",
        "force on link i from the link before, N",
    ),
    (
        "n",
        "nx_i, ny_i, nz_i",
        "moment on link i from the link before, about joint i's origin, N·m",
    ),
    ("tau", "tau_i", "torque of joint i, N·m"),
    ("friction", "friction_i", "friction of joint i, N·m"),
    ("speed2", "speed2_i", "q̇_i² + smoothing²"),
    ("speed", "speed_i", "√(q̇_i² + smoothing²)"),
    ("slope", "slope_i", "∂/∂q̇_i of the friction of joint i"),
    (
        "bias",
        "bias_i",
        "torque of joint i at zero acceleration, N·m",
    ),
    (
        "net",
        "net_i",
        "what is left of `tau` to accelerate joint i, N·m",
    ),
    ("qdd", "qdd_i", "acceleration of joint i, rad/s²"),
    (
        "velocity",
        "vx_i, vy_i, vz_i",
        "velocity of joint i's origin, m/s",
    ),
    (
        "lh",
        "lhx_i, lhy_i, lhz_i",
        "times the angular velocity of link i, the part of its kinetic energy that its turning adds",
    ),
    (
        "e_to",
        "e_to_i",
        "kinetic energy of the links up to i and of the rotors before them, J",
    ),
    (
        "psi",
        "vx_psi_i ..., wx_psi_i ...",
        "2 Ψ̇_i = 2 v_i × S_i, S_i the unit twist of joint i: how the twist is carried along",
    ),
    (
        "v2",
        "vx2_i, vy2_i, vz2_i",
        "twice the velocity of joint i's origin in the inertial frame in which that of joint i - 1 rests",
    ),
    (
        "coriolis",
        "ppx_i ..., kxy_i ...; ppx_i_own ...",
        "what the velocities of the links from i on (of link i alone) do to a twist (m, μ): the force μ × P and the moment K μ",
    ),
    (
        "k",
        "kx_i_j, ky_i_j, kz_i_j",
        "couple, at joint i: what that makes joint j feel of a turning",
    ),
    (
        "fq",
        "fqx_i_j, fqy_i_j, fqz_i_j",
        "∂/∂q_j of the force that joint j transmits, as joint i has it",
    ),
    (
        "nq",
        "nqx_i_j, nqy_i_j, nqz_i_j",
        "∂/∂q_j of the moment that joint j transmits, as joint i has it",
    ),
    (
        "fqd",
        "fqdx_i_j, fqdy_i_j, fqdz_i_j",
        "∂/∂q̇_j of the force that joint j transmits, as joint i has it",
    ),
    (
        "nqd",
        "nqdx_i_j, nqdy_i_j, nqdz_i_j",
        "∂/∂q̇_j of the moment that joint j transmits, as joint i has it",
    ),
    ("tau_q", "tau_q_i_j", "∂τ_i/∂q_j"),
    ("tau_qd", "tau_qd_i_j", "∂τ_i/∂q̇_j"),
    (
        "y",
        "y_j_i_m, y_j_i_mx ... y_j_i_izz",
        "torque of joint j at the unit parameter m, mx ... Izz of link i: an entry of the regressor Y",
    ),
    ("qqd", "qqd_i_j", "q̇_i q̇_j"),
    (
        "vel",
        "vel_i_j_k",
        "torque of joint i by the rates of joints j and k together, N·m: 2Γ_i,jk q̇_j q̇_k",
    ),
    (
        "dtau",
        "dtau_i_k",
        "torque of joint i before less after a lock of joint k, N·m",
    ),
    // Manipulability.
    (
        "h",
        "h_r_j",
        "entry of H = JM⁻¹, r counting the task's rows in the order in which they are made orthogonal",
    ),
    ("hu", "hu_r_j", "entry of HU"),
    (
        "e",
        "e_r_j, e_r_j_pk_s",
        "entry of H's row r less its parts along those before; in the k-th pass, after that along row s",
    ),
    ("ee", "ee_r", "squared length of `e_r`"),
    ("ee_inv", "ee_inv_r", "1 / `ee_r`"),
    (
        "mu",
        "mu_r_s, mu_r_s_pk",
        "share of `e_s` in row r of H; what the k-th pass finds of it",
    ),
    ("ed", "ed_r_j", "entry of (HHᵀ)⁻¹H"),
    ("w", "w_r_j", "entry of W = (HHᵀ)⁻¹HM⁻¹"),
    ("wu", "wu_r_j", "entry of WU"),
    (
        "je",
        "je_r_j, je_r_j_pk_s",
        "entry of J's row r less its parts along those before; in the k-th pass, after that along row s",
    ),
    ("jee", "jee_r", "squared length of `je_r`"),
    ("jee_inv", "jee_inv_r", "1 / `jee_r`"),
    ("jmu", "jmu_r_s", "share of `je_s` in row r of J"),
    ("jed", "jed_r_j", "entry of (JJᵀ)⁻¹J"),
    (
        "ty",
        "ty_r_j",
        "entry of Y = J U⁻ᵀ, r counting the task's rows in the order in which they are made orthogonal",
    ),
    (
        "te",
        "te_r_j, te_r_j_pk_s",
        "entry of row r of Y less its parts along those before, in the product of D⁻¹; in the k-th pass, after that along row s",
    ),
    ("te_over_d", "te_over_d_r_j", "`te_r_j` / `d_j`"),
    ("tee", "tee_r", "squared length of `te_r` in that product"),
    ("tee_inv", "tee_inv_r", "1 / `tee_r`"),
    (
        "tmu",
        "tmu_r_s, tmu_r_s_pk",
        "share of `te_s` in row r; what the k-th pass finds of it",
    ),
    (
        "ts",
        "ts_r_s",
        "entry of S⁻¹, S the unit triangular matrix of `tmu`",
    ),
    (
        "ted",
        "ted_r_j",
        "entry of the dual basis of the rows of Y in that product, times D⁻¹",
    ),
    ("lambda", "lambda_r_s", "entry of Λ: r and s are rows of J"),
    ("w_d", "w_d", "the dynamic manipulability w_D"),
    ("volume", "det_jjt", "det(JJᵀ) over the task's rows"),
    ("dlnw", "dlnw_i", "∂ln w_D/∂q_i"),
    ("dw", "dw_i", "∂w_D/∂q_i"),
    ("w_k", "w", "the kinematic manipulability w"),
    ("dlnw_k", "dlnw_i", "∂ln w/∂q_i"),
    ("dw_k", "dw_i", "∂w/∂q_i"),
    (
        "bar",
        "x_bar",
        "adjoint of x: the derivative by x of ln w_D, or of ln w where that is the result",
    ),
];

/// What names of a family look like, and what they mean; none for one that says so itself.
pub(crate) fn meaning(family: &str) -> Option<(&'static str, &'static str)> {
    let entry = LEGEND.iter().find(|(own, _, _)| *own == family);
    entry.map(|(_, names, meaning)| (*names, *meaning))
}

/// The families in the order of the legend, and then whatever is not in it.
pub(crate) fn place(family: &str) -> usize {
    let place = LEGEND.iter().position(|(own, _, _)| *own == family);
    place.unwrap_or(LEGEND.len())
}
