// Pinocchio's algorithms behind C functions. The arm's numbers, N, JOINTS, TOOL and GRAVITY, are put before this file.

#include <cstring>

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
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
using Jacobian = Map<Matrix<double, 6, N>>;

// Results are copied out as Pinocchio leaves them: M in its upper triangle.

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

void inverse_dynamics(const double *x, double *out) {
    Map<VectorXd>(out, N) = pinocchio::rnea(w.model, w.data, Vector(x, N), Vector(x + N, N), Vector(x + 2 * N, N));
}

void forward_dynamics(const double *x, double *out) {
    Map<VectorXd>(out, N) = pinocchio::aba(w.model, w.data, Vector(x, N), Vector(x + N, N), Vector(x + 2 * N, N));
}

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
};

}  // namespace

extern "C" void (*kernel(const char *, const char *quantity))(const double *, double *) {
    for (const auto &entry : KERNELS)
        if (std::strcmp(entry.name, quantity) == 0) return entry.kernel;
    return nullptr;
}
