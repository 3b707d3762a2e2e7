// Pinocchio's algorithms behind C functions. The arm's numbers, N, JOINTS, TOOL, GRAVITY and TASK, are put before this file.

#include <cmath>
#include <cstring>

#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/center-of-mass.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/energy.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/multibody.hpp>

// The two kinds of joint that tables have, and one that Pinocchio asks for. Its default collection of 25 kinds takes
// minutes and gigabytes to compile, and runs a little slower.
template <typename S, int O>
struct Joints {
    typedef S Scalar;
    static constexpr int Options = O;
    typedef pinocchio::JointModelRevoluteTpl<S, O, 2> JointModelRZ;
    typedef pinocchio::JointModelPrismaticTpl<S, O, 2> JointModelPZ;
    typedef pinocchio::JointModelMimicTpl<S, O, ::Joints> JointModelMimic;
    typedef boost::variant<JointModelRZ, JointModelPZ, boost::recursive_wrapper<JointModelMimic>> JointModelVariant;
    typedef pinocchio::JointDataRevoluteTpl<S, O, 2> JointDataRZ;
    typedef pinocchio::JointDataPrismaticTpl<S, O, 2> JointDataPZ;
    typedef pinocchio::JointDataMimicTpl<S, O, ::Joints> JointDataMimic;
    typedef boost::variant<JointDataRZ, JointDataPZ, boost::recursive_wrapper<JointDataMimic>> JointDataVariant;
};

namespace {

using Eigen::Map;
using Eigen::Matrix;
using Eigen::VectorXd;
using Matrix3 = Matrix<double, 3, 3, Eigen::RowMajor>;
using pinocchio::SE3;

using Model = pinocchio::ModelTpl<double, 0, Joints>;
using Data = pinocchio::DataTpl<double, 0, Joints>;

SE3 pose(const double *rows) {
    Map<const Matrix<double, 3, 4, Eigen::RowMajor>> matrix(rows);
    return SE3(matrix.leftCols<3>(), matrix.col(3));
}

struct World {
    Model model;
    pinocchio::FrameIndex tool;
    Data data;

    World() : tool(build(model)), data(model) {}

    static pinocchio::FrameIndex build(Model &model) {
        pinocchio::JointIndex parent = 0;
        for (int i = 0; i < N; ++i) {
            const auto &joint = JOINTS[i];
            const auto name = "joint" + std::to_string(i + 1);
            parent = joint.revolute ? model.addJoint(parent, pinocchio::JointModelRZ(), pose(joint.placement), name)
                                    : model.addJoint(parent, pinocchio::JointModelPZ(), pose(joint.placement), name);
            model.appendBodyToJoint(parent, pinocchio::Inertia(joint.mass, Eigen::Vector3d(joint.com), Matrix3(joint.inertia)));
            model.armature[i] = joint.armature;
        }
        model.gravity.linear() = Eigen::Vector3d(GRAVITY);
        return model.addFrame(pinocchio::Frame("tool", parent, pose(TOOL), pinocchio::OP_FRAME));
    }
};

World &world() {
    static World only;
    return only;
}
World &w = world();

using Vector = Map<const VectorXd>;
using VectorN = Matrix<double, N, 1>;
using Jacobian = Map<Matrix<double, 6, N>>;
using Square = Map<Matrix<double, N, N>>;
constexpr int ROWS = sizeof TASK / sizeof *TASK;

// Friction, which Pinocchio's algorithms leave to their caller: what it takes of the torques, and its derivative by the rates.

VectorN friction(const double *rates) {
    VectorN torque;
    for (int i = 0; i < N; ++i) {
        const auto &joint = JOINTS[i];
        torque[i] = joint.viscous * rates[i] + joint.coulomb * rates[i] / std::hypot(rates[i], joint.smoothing);
    }
    return torque;
}

VectorN friction_derivative(const double *rates) {
    VectorN derivative;
    for (int i = 0; i < N; ++i) {
        const auto &joint = JOINTS[i];
        const double size = std::hypot(rates[i], joint.smoothing), ratio = joint.smoothing / size;
        derivative[i] = joint.viscous + joint.coulomb * ratio * ratio / size;
    }
    return derivative;
}

// Results are copied out as Pinocchio leaves them: M and its inverse in their upper triangles, regressors in its order of parameters.

void mass_matrix(const double *x, double *out) {
    std::memcpy(out, pinocchio::crba(w.model, w.data, Vector(x, N), pinocchio::Convention::WORLD).data(), sizeof(double) * N * N);
}

void mass_matrix_local(const double *x, double *out) {
    std::memcpy(out, pinocchio::crba(w.model, w.data, Vector(x, N), pinocchio::Convention::LOCAL).data(), sizeof(double) * N * N);
}

void geometric_jacobian(const double *x, double *out) {
    Jacobian jacobian(out);
    jacobian.setZero();
    pinocchio::computeFrameJacobian(w.model, w.data, Vector(x, N), w.tool, pinocchio::LOCAL_WORLD_ALIGNED, jacobian);
}

void geometric_jacobian_of_joints(const double *x, double *out) {
    Jacobian jacobian(out);
    jacobian.setZero();
    pinocchio::computeJointJacobians(w.model, w.data, Vector(x, N));
    pinocchio::getFrameJacobian(w.model, w.data, w.tool, pinocchio::LOCAL_WORLD_ALIGNED, jacobian);
}

VectorN torques(const double *q, const double *qd, const double *qdd) {
    VectorN torque = pinocchio::rnea(w.model, w.data, Vector(q, N), Vector(qd, N), Vector(qdd, N));
    if constexpr (FRICTION) torque += friction(qd);
    return torque;
}

void inverse_dynamics(const double *x, double *out) { Map<VectorXd>(out, N) = torques(x, x + N, x + 2 * N); }

VectorN driving(const double *x) {
    VectorN torque = Vector(x + 2 * N, N);
    if constexpr (FRICTION) torque -= friction(x + N);
    return torque;
}

void forward_dynamics(const double *x, double *out) {
    Map<VectorXd>(out, N) = pinocchio::aba(w.model, w.data, Vector(x, N), Vector(x + N, N), driving(x), pinocchio::Convention::WORLD);
}

void forward_dynamics_local(const double *x, double *out) {
    Map<VectorXd>(out, N) = pinocchio::aba(w.model, w.data, Vector(x, N), Vector(x + N, N), driving(x), pinocchio::Convention::LOCAL);
}

// Rotation by columns, then translation, of each joint's frame.
void link_poses(const double *x, double *out) {
    pinocchio::forwardKinematics(w.model, w.data, Vector(x, N));
    for (int i = 1; i <= N; ++i, out += 12) {
        std::memcpy(out, w.data.oMi[i].rotation().data(), sizeof(double) * 9);
        std::memcpy(out + 9, w.data.oMi[i].translation().data(), sizeof(double) * 3);
    }
}

void link_jacobians(const double *x, double *out) {
    Map<VectorXd>(out, 6 * N * N).setZero();
    pinocchio::computeJointJacobians(w.model, w.data, Vector(x, N));
    for (int i = 1; i <= N; ++i, out += 6 * N) {
        Jacobian jacobian(out);
        pinocchio::getJointJacobian(w.model, w.data, i, pinocchio::LOCAL_WORLD_ALIGNED, jacobian);
    }
}

void center_of_mass(const double *x, double *out) {
    Map<Eigen::Vector3d>(out, 3) = pinocchio::centerOfMass(w.model, w.data, Vector(x, N), false);
}

void jacobian_rate(const double *x, double *out) {
    Jacobian rate(out);
    rate.setZero();
    pinocchio::computeJointJacobiansTimeVariation(w.model, w.data, Vector(x, N), Vector(x + N, N));
    pinocchio::updateFramePlacement(w.model, w.data, w.tool);
    pinocchio::getFrameJacobianTimeVariation(w.model, w.data, w.tool, pinocchio::LOCAL_WORLD_ALIGNED, rate);
}

void bias_acceleration(const double *x, double *out) {
    static const VectorXd none = VectorXd::Zero(N);
    pinocchio::forwardKinematics(w.model, w.data, Vector(x, N), Vector(x + N, N), none);
    pinocchio::updateFramePlacement(w.model, w.data, w.tool);
    Map<Matrix<double, 6, 1>>(out, 6) =
        pinocchio::getFrameClassicalAcceleration(w.model, w.data, w.tool, pinocchio::LOCAL_WORLD_ALIGNED).toVector();
}

void coriolis_matrix(const double *x, double *out) {
    std::memcpy(out, pinocchio::computeCoriolisMatrix(w.model, w.data, Vector(x, N), Vector(x + N, N)).data(), sizeof(double) * N * N);
}

// By rows.
void inverse_mass_matrix(const double *x, double *out) {
    std::memcpy(out, pinocchio::computeMinverse(w.model, w.data, Vector(x, N)).data(), sizeof(double) * N * N);
}

void kinetic_energy(const double *x, double *out) {
    *out = pinocchio::computeKineticEnergy(w.model, w.data, Vector(x, N), Vector(x + N, N));
}

void potential_energy(const double *x, double *out) { *out = pinocchio::computePotentialEnergy(w.model, w.data, Vector(x, N)); }

// Over the task's rows: M's factor L, then the inverse of X'X, X = inv(L) J'.
struct Task {
    Matrix<double, N, N> mass;
    Eigen::LLT<Eigen::Ref<Matrix<double, N, N>>, Eigen::Upper> factor;
    Matrix<double, N, ROWS> half;
    Matrix<double, ROWS, ROWS> inertia;

    explicit Task(const double *x) : mass(pinocchio::crba(w.model, w.data, Vector(x, N), pinocchio::Convention::WORLD)), factor(mass) {
        Matrix<double, 6, N> jacobian = Matrix<double, 6, N>::Zero();
        pinocchio::computeFrameJacobian(w.model, w.data, Vector(x, N), w.tool, pinocchio::LOCAL_WORLD_ALIGNED, jacobian);
        for (int row = 0; row < ROWS; ++row) half.col(row) = jacobian.row(TASK[row]);
        factor.matrixL().solveInPlace(half);
        inertia = (half.transpose() * half).eval().llt().solve(Matrix<double, ROWS, ROWS>::Identity());
    }
};

void task_space_inertia(const double *x, double *out) {
    const Task task(x);
    Map<Matrix<double, 6, 6>> inertia(out);
    inertia.setZero();
    for (int i = 0; i < ROWS; ++i)
        for (int j = 0; j < ROWS; ++j) inertia(TASK[i], TASK[j]) = task.inertia(i, j);
}

void dynamically_consistent_inverse(const double *x, double *out) {
    const Task task(x);
    Matrix<double, N, ROWS> inverse = task.half * task.inertia;
    task.factor.matrixU().solveInPlace(inverse);
    Map<Matrix<double, N, 6>> all(out);
    all.setZero();
    for (int i = 0; i < ROWS; ++i) all.col(TASK[i]) = inverse.col(i);
}

// Into M of Pinocchio's data; the others straight to where they are wanted, or as Pinocchio keeps them, by rows.

void inverse_dynamics_derivatives(const double *x, double *out) {
    Square by_q(out), by_qd(out + N * N);
    pinocchio::computeRNEADerivatives(w.model, w.data, Vector(x, N), Vector(x + N, N), Vector(x + 2 * N, N), by_q, by_qd, w.data.M);
    if constexpr (FRICTION) by_qd.diagonal() += friction_derivative(x + N);
}

void inverse_dynamics_derivatives_by_rows(const double *x, double *out) {
    pinocchio::computeRNEADerivatives(w.model, w.data, Vector(x, N), Vector(x + N, N), Vector(x + 2 * N, N));
    std::memcpy(out, w.data.dtau_dq.data(), sizeof(double) * N * N);
    std::memcpy(out + N * N, w.data.dtau_dv.data(), sizeof(double) * N * N);
    if constexpr (FRICTION) Square(out + N * N).diagonal() += friction_derivative(x + N);
}

void forward_dynamics_derivatives(const double *x, double *out) {
    Square by_q(out), by_qd(out + N * N), by_tau(out + 2 * N * N);
    pinocchio::computeABADerivatives(w.model, w.data, Vector(x, N), Vector(x + N, N), driving(x), by_q, by_qd, by_tau);
    if constexpr (FRICTION) by_qd -= by_tau * friction_derivative(x + N).asDiagonal();
}

void forward_dynamics_derivatives_by_rows(const double *x, double *out) {
    pinocchio::computeABADerivatives(w.model, w.data, Vector(x, N), Vector(x + N, N), driving(x));
    if constexpr (FRICTION) w.data.ddq_dv -= w.data.Minv * friction_derivative(x + N).asDiagonal();
    std::memcpy(out, w.data.ddq_dq.data(), sizeof(double) * N * N);
    std::memcpy(out + N * N, w.data.ddq_dv.data(), sizeof(double) * N * N);
    std::memcpy(out + 2 * N * N, w.data.Minv.data(), sizeof(double) * N * N);
}

void regressor(const double *x, double *out) {
    const auto &all = pinocchio::computeJointTorqueRegressor(w.model, w.data, Vector(x, N), Vector(x + N, N), Vector(x + 2 * N, N));
    std::memcpy(out, all.data(), sizeof(double) * 10 * N * N);
}

void lock_impacts(const double *x, double *out) {
    Square impacts(out);
    const VectorN before = torques(x, x + N, x + 2 * N);
    VectorN rates = Vector(x + N, N), accelerations = Vector(x + 2 * N, N);
    for (int k = 0; k < N; ++k) {
        rates[k] = accelerations[k] = 0;
        impacts.col(k) = before - torques(x, rates.data(), accelerations.data());
        if constexpr (FRICTION) impacts(k, k) -= friction(x + N)[k];
        rates[k] = x[N + k];
        accelerations[k] = x[2 * N + k];
    }
}

// What comes after a slash is another way to the same: peers/measure.py.
const struct {
    const char *name;
    void (*kernel)(const double *, double *);
} KERNELS[] = {
    {"mass_matrix", mass_matrix},
    {"mass_matrix/local", mass_matrix_local},
    {"geometric_jacobian", geometric_jacobian},
    {"geometric_jacobian/joints", geometric_jacobian_of_joints},
    {"inverse_dynamics", inverse_dynamics},
    {"forward_dynamics", forward_dynamics},
    {"forward_dynamics/local", forward_dynamics_local},
    {"link_poses", link_poses},
    {"link_jacobians", link_jacobians},
    {"center_of_mass", center_of_mass},
    {"jacobian_rate", jacobian_rate},
    {"bias_acceleration", bias_acceleration},
    {"coriolis_matrix", coriolis_matrix},
    {"inverse_mass_matrix", inverse_mass_matrix},
    {"kinetic_energy", kinetic_energy},
    {"potential_energy", potential_energy},
    {"task_space_inertia", task_space_inertia},
    {"dynamically_consistent_inverse", dynamically_consistent_inverse},
    {"inverse_dynamics_derivatives", inverse_dynamics_derivatives},
    {"inverse_dynamics_derivatives/rows", inverse_dynamics_derivatives_by_rows},
    {"forward_dynamics_derivatives", forward_dynamics_derivatives},
    {"forward_dynamics_derivatives/rows", forward_dynamics_derivatives_by_rows},
    {"regressor", regressor},
    {"lock_impacts", lock_impacts},
};

}  // namespace

extern "C" void (*kernel(const char *, const char *quantity))(const double *, double *) {
    for (const auto &entry : KERNELS)
        if (std::strcmp(entry.name, quantity) == 0) return entry.kernel;
    return nullptr;
}
