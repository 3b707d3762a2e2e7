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
    ("d_inv", "d_inv_i", "1 / `d_i`"),
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
        "ax_i ..., ax_i_before ...",
        "acceleration of joint i's origin less gravity, m/s²; the same in the axes of the link before",
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
        "je_r_j",
        "entry of J's row r less its parts along those before",
    ),
    ("jee", "jee_r", "squared length of `je_r`"),
    ("jee_inv", "jee_inv_r", "1 / `jee_r`"),
    ("jmu", "jmu_r_s", "share of `je_s` in row r of J"),
    (
        "te",
        "te_r_j",
        "entry of row r of J U⁻ᵀ less its parts along those before, in the product of D⁻¹",
    ),
    ("tee", "tee_r", "squared length of `te_r` in that product"),
    ("tee_inv", "tee_inv_r", "1 / `tee_r`"),
    (
        "tmu",
        "tmu_r_s, tmu_r_s_pk",
        "share of `te_s` in row r; what the k-th pass finds of it",
    ),
    ("w_d", "w_d", "the dynamic manipulability w_D"),
    ("volume", "det_jjt", "det(JJᵀ) over the task's rows"),
    ("dlnw", "dlnw_i", "∂ln w_D/∂q_i"),
    ("dw", "dw_i", "∂w_D/∂q_i"),
    ("bar", "x_bar", "adjoint of x: ∂ln w_D/∂x"),
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
