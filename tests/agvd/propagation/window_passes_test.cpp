// The passes of the window front, on states that are filled by hand.
#include <gtest/gtest.h>

#include <limits>

#include "agvd/propagation/window/window_front.h"
#include "support/shapes.h"

using namespace agvd;

namespace {

Window new_window(double x, double y, double weight, double begin, double end) {
    Window w{x, y, weight, begin, end, infinity, infinity, 0, false};
    w.at_begin = w.weight + std::hypot(begin - x, y);
    w.at_end = w.weight + std::hypot(end - x, y);
    return w;
}

// A front on a tetrahedron of edge length 1 (before it is scaled), on which nothing has come.
struct Front {
    Surface surface;
    Corners corners;
    std::vector<float> bounds;
    WindowFront state;

    Front()
        : surface(build_surface(unit_tetrahedron().view())),
          corners(surface, 1),
          bounds(surface.num_vertices(), std::numeric_limits<float>::infinity()),
          state(surface, corners, 0, {}, 0) {
        state.bounds = bounds;
    }

    static TriangleMesh unit_tetrahedron() {
        TriangleMesh mesh = shapes::tetrahedron();
        const double length = (mesh.positions[0] - mesh.positions[1]).norm();
        for (Vec3& p : mesh.positions) p /= length;
        return mesh;
    }
    HalfEdgeEnds ends_of(Index half_edge) {
        const Index tail = vertex_record(state, surface.tail(half_edge));
        return {half_edge, tail, vertex_record(state, surface.head(half_edge))};
    }
    EdgeRecord& edge(Index half_edge) { return state.edges.records[state.edges.find(half_edge)]; }
    WindowFace face(Index half_edge) {
        WindowFace result(corners, half_edge);
        result.tail_bound = state.vertices.records[edge(half_edge).tail].bound;
        result.head_bound = state.vertices.records[edge(half_edge).head].bound;
        result.apex_record = vertex_record(state, surface.tail(Surface::previous(half_edge)));
        return result;
    }
};

}  // namespace

TEST(WindowPasses, WindowsThatWaitBecomeOneEnvelope) {
    Front front;
    const HalfEdgeEnds to = front.ends_of(0);
    send(front.state, to, new_window(0.2, -1, 0, 0, 0.7));
    send(front.state, to, new_window(0.8, -1, 0, 0.3, 1));
    take_in_windows(front.state, front.edge(0), front.face(0));
    EXPECT_EQ(front.edge(0).waiting, no_index);
    const std::span<const Window> windows = front.state.store[front.edge(0).windows];
    ASSERT_EQ(windows.size(), 2u);
    EXPECT_EQ(windows[0].begin, 0);
    EXPECT_NEAR(windows[0].end, 0.5, 1e-14);
    EXPECT_EQ(windows[0].end, windows[1].begin);
    EXPECT_EQ(windows[1].end, 1);
}

TEST(WindowPasses, BoundsOfTheEndsBeatWindows) {
    Front front;
    const HalfEdgeEnds to = front.ends_of(0);
    front.state.vertices.lower_bound(to.tail, 0.5);
    send(front.state, to, new_window(0.2, -1, 0, 0, 0.3));
    take_in_windows(front.state, front.edge(0), front.face(0));
    EXPECT_EQ(front.edge(0).windows, no_index);
}

TEST(WindowPasses, AWindowIsDividedAtTheRayToTheApex) {
    Front front;
    (void)front.state.edges.add(front.ends_of(0));
    const WindowFace face = front.face(0);
    const Window w = new_window(0.5, -1, 0.25, 0, 1);
    const Division division = divide(front.state, w, front.edge(0), face);
    EXPECT_EQ(division.right.window, &w);
    EXPECT_EQ(division.left.window, &w);
    EXPECT_TRUE(division.right.is_apex && division.left.is_apex);
    EXPECT_NEAR(division.right.limit, 0.5, 1e-14);
    const VertexRecord& apex = front.state.vertices.records[face.apex_record];
    EXPECT_NEAR(apex.low, 1.25 + std::sqrt(0.75), 1e-14);
    // A worse window goes on from the best ray only.
    const Window worse = new_window(0.9, -1, 1, 0, 1);
    const Division late = divide(front.state, worse, front.edge(0), face);
    EXPECT_FALSE(late.left.is_apex);
    EXPECT_NEAR(late.left.limit, 0.5, 1e-14);
    EXPECT_NEAR(apex.low, 1.25 + std::sqrt(0.75), 1e-14);
}

TEST(WindowPasses, ServingSendsBothPartsOn) {
    Front front;
    send(front.state, front.ends_of(0), new_window(0.5, -0.5, 0, 0, 1));
    const Index record = front.state.edges.find(0);
    serve_edge(front.state, record);
    EXPECT_EQ(front.state.num_served, 1u);
    EXPECT_EQ(front.state.edges.records[record].num_served, 1u);
    for (const Index out : {Index{1}, Index{2}}) {
        const Index twin = front.surface.twin[out];
        ASSERT_NE(front.state.edges.find(twin), no_index);
        const EdgeRecord& next = front.edge(twin);
        ASSERT_NE(next.waiting, no_index);
        const Window& child = front.state.store[next.waiting].front();
        EXPECT_NEAR(std::min(child.begin, 1 - child.end), 0, 1e-14);
        EXPECT_NEAR(child.end - child.begin, 1, 1e-14);
    }
}

TEST(WindowPasses, HalfEdgesBehindTheFrontAreClosed) {
    Front front;
    const KeptFaces keeps = [](Index face) { return face == 1; };
    front.state.keeps = &keeps;
    for (const Index h : {Index{0}, Index{3}, Index{6}}) {  // Closed, kept, and still waiting.
        const HalfEdgeEnds to = front.ends_of(h);
        front.state.vertices.lower_bound(to.tail, 0.1);
        front.state.vertices.lower_bound(to.head, 0.1);
        send(front.state, to, new_window(0.5, -0.001, 0, 0.2, 0.8));
        if (h < 6) take_in_windows(front.state, front.edge(h), front.face(h));
        watch(front.state, front.state.edges.find(h), 1);
    }
    // The queue goes on to a bucket far behind all bounds.
    Index bucket = no_index;
    front.state.queue.push(FrontItem::pseudo_source(0), 100, bucket);
    while (!front.state.queue.empty()) (void)front.state.queue.pop([](FrontItem) {});
    close_edges(front.state);
    EXPECT_EQ(front.state.edges.find(0), no_index);
    ASSERT_NE(front.state.edges.find(3), no_index);
    EXPECT_NE(front.edge(3).windows, no_index);
    ASSERT_NE(front.state.edges.find(6), no_index);
    EXPECT_NE(front.edge(6).waiting, no_index);
}

TEST(EdgeTable, RecordsGivenBackAreUsedAgain) {
    EdgeTable edges;
    edges.record_of.assign(12, 0);
    for (const Index h : {Index{5}, Index{2}, Index{9}}) (void)edges.add({h, 0, 1});
    EXPECT_EQ(edges.find(2), 1u);
    edges.give_back(1);
    EXPECT_EQ(edges.find(2), no_index);
    EXPECT_EQ(edges.add({7, 0, 1}), 1u);
    EXPECT_EQ(edges.add({8, 0, 1}), 3u);
    EXPECT_EQ(edges.by_arrival(), (std::vector<Index>{0, 2, 1, 3}));
    EXPECT_EQ(edges.num_arrivals, 5u);
}

TEST(PseudoSourceTable, RecordsTakenAreUsedAgain) {
    PseudoSourceTable sources;
    EXPECT_EQ(sources.add({3, 0, 0, 0, 1.5}), 0u);
    EXPECT_EQ(sources.add({4, 0, 0, 0, 2.5}), 1u);
    EXPECT_EQ(sources.take(0).distance, 1.5);
    EXPECT_EQ(sources.add({5, 0, 0, 0, 3.5}), 0u);
    EXPECT_EQ(sources.take(1).vertex, 4u);
    EXPECT_EQ(sources.take(0).vertex, 5u);
}
