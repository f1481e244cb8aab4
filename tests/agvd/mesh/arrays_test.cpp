#include "agvd/mesh/arrays.h"

#include <gtest/gtest.h>

#include <array>

#include "support/shapes.h"

using agvd::AdaptedMesh;
using agvd::Index;
using agvd::MeshView;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec3;

namespace {

template <typename Scalar, int Order>
using Rows = Eigen::Matrix<Scalar, Eigen::Dynamic, 3, Order>;

// The mesh as matrices of these scalars and orders, with integers for coordinates.
template <typename V, typename F>
struct Matrices {
    explicit Matrices(const TriangleMesh& mesh)
        : positions(static_cast<Eigen::Index>(mesh.positions.size()), 3),
          triangles(static_cast<Eigen::Index>(mesh.triangles.size()), 3) {
        for (Eigen::Index i = 0; i < positions.rows(); ++i) {
            for (Eigen::Index k = 0; k < 3; ++k) {
                positions(i, k) =
                    static_cast<typename V::Scalar>(mesh.positions[static_cast<std::size_t>(i)][k]);
            }
        }
        for (Eigen::Index i = 0; i < triangles.rows(); ++i) {
            for (Eigen::Index k = 0; k < 3; ++k) {
                triangles(i, k) = static_cast<typename F::Scalar>(
                    mesh.triangles[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]);
            }
        }
    }
    V positions;
    F triangles;
};

void expect_equal(const MeshView& view, const TriangleMesh& mesh) {
    EXPECT_TRUE(std::ranges::equal(view.positions, mesh.positions));
    EXPECT_TRUE(std::ranges::equal(view.triangles, mesh.triangles));
}

TriangleMesh large_cube() {
    TriangleMesh mesh = shapes::cube();
    for (agvd::Vec3& p : mesh.positions) p = (10 * p).array().round();
    return mesh;
}

template <typename V, typename F>
void expect_adapted(bool sees_positions, bool sees_triangles) {
    const TriangleMesh mesh = large_cube();
    const Matrices<V, F> matrices(mesh);
    const AdaptedMesh adapted = agvd::from_matrices(matrices.positions, matrices.triangles);
    expect_equal(adapted, mesh);
    const MeshView view = adapted;
    EXPECT_EQ(sees_positions, static_cast<const void*>(view.positions.data()) ==
                                  static_cast<const void*>(matrices.positions.data()));
    EXPECT_EQ(sees_triangles, static_cast<const void*>(view.triangles.data()) ==
                                  static_cast<const void*>(matrices.triangles.data()));
}

TEST(EigenAdapter, RowsOfDoublesAnd32BitIntegersAreNotCopied) {
    using Eigen::ColMajor;
    using Eigen::RowMajor;
    expect_adapted<Rows<double, RowMajor>, Rows<Index, RowMajor>>(true, true);
    expect_adapted<Rows<double, RowMajor>, Rows<int, RowMajor>>(true, true);
    expect_adapted<Rows<double, ColMajor>, Rows<int, RowMajor>>(false, true);
    expect_adapted<Rows<double, RowMajor>, Rows<int, ColMajor>>(true, false);
    expect_adapted<Rows<float, RowMajor>, Rows<std::int64_t, RowMajor>>(false, false);
    expect_adapted<Rows<int, RowMajor>, Rows<short, ColMajor>>(false, false);
    expect_adapted<Rows<double, RowMajor>, Rows<float, RowMajor>>(true, false);
    expect_adapted<Eigen::MatrixXd, Eigen::MatrixXi>(false, false);
    expect_adapted<Eigen::MatrixXf, Eigen::Matrix<std::size_t, -1, -1, RowMajor>>(false, false);
    expect_adapted<Rows<long double, ColMajor>, Rows<double, RowMajor>>(false, false);
}

TEST(EigenAdapter, TransposesBlocksAndExpressionsAreAsGood) {
    const TriangleMesh mesh = large_cube();
    const Matrices<Eigen::MatrixXd, Eigen::MatrixXi> matrices(mesh);
    const Eigen::MatrixXd columns = matrices.positions.transpose();
    const Eigen::MatrixXi corners = matrices.triangles.transpose();
    const AdaptedMesh seen = agvd::from_matrices(columns.transpose(), corners.transpose());
    expect_equal(seen, mesh);
    EXPECT_EQ(seen.seen.positions.data()->data(), columns.data());
    EXPECT_EQ(seen.seen.triangles.size(), 12u);

    Eigen::Matrix<double, -1, -1, Eigen::RowMajor> wide(8, 5);
    wide.setConstant(7);
    wide.middleCols(1, 3) = matrices.positions;
    const AdaptedMesh copied =
        agvd::from_matrices(wide.middleCols(1, 3), (matrices.triangles.array() + 1).matrix() -
                                                       Eigen::MatrixXi::Constant(12, 3, 1));
    expect_equal(copied, mesh);
    EXPECT_EQ(copied.copied.positions.size(), 8u) << "rows with gaps must be copied";
}

TEST(EigenAdapter, ColumnsOfThreeAreNoRows) {
    Eigen::Matrix3d v;
    v << 0, 0, 0, 1, 0, 0, 0, 2, 0;
    Eigen::Matrix3i f;
    f << 0, 1, 2, 1, 0, 2, 2, 1, 0;
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{0, 1, 2}, {1, 0, 2}, {2, 1, 0}}};
    expect_equal(agvd::from_matrices(v, f), mesh);
}

TEST(EigenAdapter, MatricesOfResultsAreTheirArrays) {
    const TriangleMesh mesh = large_cube();
    const auto v = agvd::matrix_of(mesh.positions);
    EXPECT_EQ(v.data(), mesh.positions.data()->data());
    EXPECT_EQ(v.rows(), 8);
    EXPECT_EQ(v.row(5).transpose(), mesh.positions[5]);
    const Eigen::MatrixXi f = agvd::matrix_of(mesh.triangles).cast<int>();
    EXPECT_EQ(f.rows(), 12);
    EXPECT_EQ(f(7, 1), static_cast<int>(mesh.triangles[7][1]));
    expect_equal(agvd::from_matrices(Eigen::MatrixXd(v), f), mesh);
}

TEST(EigenAdapter, WhatIsNoMeshIsRefused) {
    const Eigen::MatrixXd v = Eigen::MatrixXd::Zero(4, 3);
    const auto adapt = [&](const auto& f) { static_cast<void>(agvd::from_matrices(v, f)); };
    EXPECT_THROW(adapt(Eigen::MatrixXi(Eigen::MatrixXi::Zero(3, 4))), agvd::InvalidInput);
    EXPECT_THROW(adapt(Eigen::MatrixXi(Eigen::MatrixXi::Constant(1, 3, -1))), agvd::InvalidInput);
    using Wide = Eigen::Matrix<std::int64_t, 1, 3>;
    EXPECT_THROW(adapt(Wide(0, 1, std::int64_t{1} << 32)), agvd::InvalidInput);
    EXPECT_THROW(adapt(Wide(0, 1, agvd::no_index)), agvd::InvalidInput);
    EXPECT_NO_THROW(adapt(Wide(0, 1, agvd::no_index - 1)));
    EXPECT_THROW(static_cast<void>(agvd::from_matrices(Eigen::MatrixXd(3, 4), Wide(0, 1, 2))),
                 agvd::InvalidInput);
    EXPECT_NO_THROW(adapt(Eigen::MatrixXi()));
}

TEST(TriangleMesh, ConvertsToAViewByItself) {
    const TriangleMesh mesh = shapes::cube();
    const MeshView view = mesh;
    EXPECT_EQ(view.positions.data(), mesh.positions.data());
    EXPECT_EQ(view.triangles.data(), mesh.triangles.data());
    EXPECT_EQ(agvd::build_surface(mesh).num_faces(), 12u);
}

// Four points and two triangles, however they are given.
void expect_square(const AdaptedMesh& adapted) {
    const MeshView view = adapted;
    const std::vector<Vec3> positions{{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
    EXPECT_TRUE(std::ranges::equal(view.positions, positions));
    EXPECT_TRUE(std::ranges::equal(view.triangles, triangles));
}

TEST(ArrayAdapter, NumbersInARowAreAMesh) {
    const std::vector<double> positions{0, 0, 5, 1, 0, 5, 1, 1, 5, 0, 1, 5};
    const std::array<int, 6> corners{0, 1, 2, 0, 2, 3};
    const AdaptedMesh mesh = agvd::from_arrays(positions, corners);
    expect_square(mesh);
    EXPECT_EQ(mesh.seen.positions.data()->data(), positions.data());
    EXPECT_EQ(static_cast<const void*>(mesh.seen.triangles.data()), corners.data());

    const std::vector<float> floats(positions.begin(), positions.end());
    const std::vector<std::int64_t> wide(corners.begin(), corners.end());
    const AdaptedMesh copied = agvd::from_arrays(std::span(floats), std::span(wide));
    expect_square(copied);
    EXPECT_TRUE(copied.seen.positions.empty() && copied.seen.triangles.empty());
}

TEST(ArrayAdapter, StructuresOfThreeAreAMesh) {
    const std::vector<std::array<float, 3>> floats{{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}};
    const unsigned short corners[2][3] = {{0, 1, 2}, {0, 2, 3}};
    expect_square(agvd::from_arrays(floats, corners));
    const std::vector<Vec3> positions{{0, 0, 5}, {1, 0, 5}, {1, 1, 5}, {0, 1, 5}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
    const AdaptedMesh mesh = agvd::from_arrays(positions, triangles);
    expect_square(mesh);
    EXPECT_EQ(mesh.seen.positions.data(), positions.data());
    EXPECT_EQ(mesh.seen.triangles.data(), triangles.data());
}

TEST(ArrayAdapter, NumbersThatAreLeftOverAreRefused) {
    const std::vector<double> positions(10);
    const std::vector<int> corners{0, 1, 2};
    EXPECT_THROW(static_cast<void>(agvd::from_arrays(positions, corners)), agvd::InvalidInput);
    EXPECT_THROW(static_cast<void>(agvd::from_arrays(corners, positions)), agvd::InvalidInput);
}

}  // namespace
