//! \file
//! Multi-source geodesic distances, the first stage of a diagram: no distance exceeds the exact one
//! by more than Propagation::certified_error.
//! Held by WindowEngine.ErrorsStayBelowWhatIsCertified in tests/agvd/propagation.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"

namespace agvd {

//! The algorithm that carries distances over the faces. Both return the same Propagation.
enum class Engine : std::uint8_t {
    Window,   //!< Exact windows, merged as far as max_error allows: our AGVD.
    Steiner,  //!< Steiner points on the edges, [meng2023] Algorithm 1: the paper's AGVD.
};

//! Lower-case name of an engine, for command lines and reports.
[[nodiscard]] const char* engine_name(Engine engine);

//! What the points given as sites stand for. `{}`: point i is site i, at distance 0 from itself.
struct SitePoints {
    //! #points: the site that each point belongs to, of 0, 1, ...; the distance from a site is the
    //! least from its points. Empty: point i is site i.
    std::vector<Index> site = {};
    //! #points, mesh units, finite, >= 0: the distance that each point starts with, an additive
    //! weight. A site none of whose points is the nearest at its own place owns nothing. Empty: 0.
    std::vector<double> start = {};

    //! The site of a point.
    [[nodiscard]] Index site_of(Index point) const { return site.empty() ? point : site[point]; }

    //! Whether both say the same in the same words.
    friend bool operator==(const SitePoints&, const SitePoints&) = default;
};

//! A line or a region as a site, or as a part of one: all of its points are at its start.
struct SiteShape {
    //! Edges of the surface, in any order: an open or closed line, or several, which may branch.
    std::vector<Index> edges = {};
    //! Faces of the surface, in any order: a region with all that lies inside.
    std::vector<Index> faces = {};
    //! The site that it belongs to, numbered as in SitePoints::site: points and shapes of the same
    //! number are one site.
    Index site = 0;
    //! Mesh units, finite, >= 0: the distance that it starts with, an additive weight.
    double start = 0;

    //! Whether both say the same in the same words.
    friend bool operator==(const SiteShape&, const SiteShape&) = default;
};

//! Sites on a surface: points, what they stand for, lines and regions.
struct SurfaceSites {
    std::vector<SurfacePoint> points = {};  //!< As propagate() takes them.
    SitePoints roles = {};                  //!< For PropagationOptions::points.
    std::vector<SiteShape> shapes = {};     //!< For PropagationOptions::shapes.
};

//! Sites on a surface that was cut open. Of a cut a point or line has one side only, that of its
//! face. Where points, or lines or their ends, are on a cut, the other sides become parts of the
//! same sites. Regions stay as they are. Added points come behind all given ones.
//! \param whole, opened  what cut_along() got and gave.
//! \param sites          on `opened`.  Cost: O(faces around them + n log n).
[[nodiscard]] SurfaceSites on_all_sides(const Surface& whole, const Surface& opened,
                                        SurfaceSites sites);

//! `{}` gives the defaults.
struct PropagationOptions {
    SitePoints points = {};              //!< What the points given as sites stand for.
    std::vector<SiteShape> shapes = {};  //!< Lines and regions, besides the points.
    Engine engine = Engine::Window;      //!< How distances are computed.
    //! Relative distance error, in [0, 1); 0: exact in double. Certified: see
    //! Propagation::certified_error. The window engine takes .005 for more, which is slower from
    //! few sites. Unset: the window engine takes default_max_error, the Steiner engine certifies
    //! nothing. If set, the Steiner engine inserts points where they are needed until the bound
    //! holds at every vertex, up to 1000 on an edge; it cannot be exact, and 0 is an error, as is
    //! any with shapes.
    std::optional<double> max_error = {};
    //! Steiner engine, m: Steiner points on each edge, in [0, 1000]; the first ones with max_error.
    int steiner_points = 8;
    //! Steiner engine: triangles are retired every lambda * #F pops, > 0. With max_error they all
    //! stay until the end.
    double lambda = 1;
    //! Window engine: no path longer than this counts, in mesh units, >= 0. Vertices farther away
    //! are reached by no site. Windows end there, so that their cost is that of the faces reached.
    double max_distance = std::numeric_limits<double>::infinity();
    //! Window engine: faces that are listed as mixed whatever labels they hold, ascending. Their
    //! relays give the distance at each of their points. See all_faces().
    std::vector<Index> relay_faces = {};
    int num_threads = 0;     //!< >= 0; 0: all cores. The same bytes for any number.
    Progress progress = {};  //!< Polled during the call; see agvd::poll.
};

//! max_error of the window engine where none is asked for.
inline constexpr double default_max_error = 1e-4;

//! An additively weighted point seen from inside a face ([meng2023] Sec. 4.2): a point p of the
//! face has distance weight + |image - p| from `site` through the relay. The image (x, y) is given
//! in the frame of `half_edge` of that face. With y < 0 the image lies across that edge: only
//! chords through [begin, end] of the edge
//! are straight, others bend at the nearer end of the interval. With y >= 0 the image lies in the
//! (convex) face itself and sees all of it. With y = -infinity the site is a line, or the border of
//! a region, and the paths are parallel: see is_parallel(). With y = infinity a region holds the
//! face, and `weight` is the distance at all of its points.
struct Relay {
    //! Of the image, along the half-edge, mesh units. Of parallel paths the component of the unit
    //! vector towards the site along the half-edge.
    double x = 0;
    double y = 0;  //!< Of the image, to the left of the half-edge.
    //! Distance from the site to the image. An image that stands for several may lie farther off
    //! than the site, with a weight below 0. Of parallel paths the distance at the half-edge's
    //! tail.
    double weight = 0;
    //! Visible interval on the half-edge, 0 <= begin <= end <= length.
    double begin = 0;
    double end = 0;              //!< See begin.
    SiteId site;                 //!< Whose image it is.
    Index half_edge = no_index;  //!< In whose frame the image lies.
};

//! Whether a relay has no image. It stands for parallel paths from a line: with the unit vector u =
//! (x, -sqrt(1 - x^2)) towards the line, a point p has distance weight - p u, as from an image at
//! infinity; or for a region that holds the face, with u = 0.
[[nodiscard]] inline bool is_parallel(const Relay& relay) {
    return relay.y == -infinity || relay.y == infinity;
}

//! [begin, end) of Propagation::relays.
struct RelayRange {
    Index begin = 0;  //!< First relay.
    Index end = 0;    //!< One past the last relay.
    //! Whether both ends are equal.
    friend bool operator==(const RelayRange&, const RelayRange&) = default;
};

//! Distances that differ by less than this share are tied: it is a few hundred roundings of a
//! path's length.
inline constexpr double tie_tolerance = 1e-13;

//! Whether a site is nearer than another one, or tied with it and of a lower number.
[[nodiscard]] inline bool is_nearer(double distance, Index site, double other_distance,
                                    Index other_site) {
    const double slack = tie_tolerance * distance;
    if (distance < other_distance - slack) return true;
    return distance <= other_distance + slack && site < other_site;
}

//! For each vertex its distance and nearest site, and, in the faces where labels meet, the relays
//! through which distances reach them. Distances are lengths of real paths: but for rounding, they
//! are never below the exact geodesic distance.
struct Propagation {
    std::vector<SiteId> vertex_site;      //!< #V; invalid where no site reaches.
    std::vector<double> vertex_distance;  //!< #V; infinity where no site reaches.

    //! #points, as SitePoints::site; empty: point i is site i, and starts at 0.
    std::vector<Index> site_of_point;
    std::vector<double> start_of_point;  //!< As SitePoints::start.

    std::vector<SiteShape> shapes;  //!< Those of the options: lines and regions among the sites.

    //! Ascending: vertices that a site reaches, but no window. Their distance is the length of a
    //! path along edges and across pairs of faces, rounded up. Windows with errors leave such gaps;
    //! exact windows do where lengths of edges differ by more than rounding allows.
    std::vector<Index> vertices_off_windows;

    //! Faces that may hold more than one label, ascending. Contract: an edge between a listed and
    //! an unlisted face, and a whole unlisted face, lie in the cell of their vertices' one site.
    //! Those of PropagationOptions::relay_faces are among them.
    std::vector<Index> mixed_faces;
    std::vector<RelayRange> relay_ranges;  //!< #mixed: where the relays of each mixed face stand.
    //! Ordered by face.
    std::vector<Relay> relays;

    //! Certified: no distance, at a vertex or through the relays, exceeds the exact one by more
    //! than this share of it (rounding in double apart); starts are part of distances. The Steiner
    //! engine's bound holds at the vertices only. Infinity: nothing is certified.
    double certified_error = std::numeric_limits<double>::infinity();

    std::size_t peak_bytes = 0;  //!< Most bytes held at once beyond the mesh, result included.
    //! Work done: graph nodes reached (in the last round of insertions), or windows served.
    std::size_t num_nodes = 0;
};

//! 0, 1, ... for PropagationOptions::relay_faces: relays in all faces take about 60 bytes a window.
[[nodiscard]] std::vector<Index> all_faces(const Surface& surface);

//! The position of a face in Propagation::mixed_faces; nothing if it is not there. Cost: O(log n).
[[nodiscard]] std::optional<Index> mixed_index_of(const Propagation& propagation, Index face);

//! The relays of one mixed face.
[[nodiscard]] inline std::span<const Relay> relays_of(const Propagation& propagation,
                                                      Index mixed_index) {
    const auto [begin, end] = propagation.relay_ranges[mixed_index];
    return std::span(propagation.relays).subspan(begin, end - begin);
}

struct ArcGraph;
class Corners;

//! What propagation computes from the surface alone, for callers that propagate on one surface
//! several times. It takes about 160 bytes per face, beyond the surface. It is immutable, so that
//! threads may share it; copies share the memory.
class SurfaceLayout {
public:
    //! \param num_threads  >= 0; 0: all cores.
    //! Cost: O(#H), about that of one Dijkstra sweep over the edges.
    //! \throw Cancelled  the progress callback returned false.
    explicit SurfaceLayout(const Surface& surface, int num_threads = 0,
                           const Progress& progress = {});

    //! The corners of the faces, for the engines; users may outlive the layout.
    [[nodiscard]] const std::shared_ptr<const Corners>& corners() const { return corners_; }
    //! Edges and lines across them, for upper bounds.
    [[nodiscard]] const ArcGraph& arcs() const { return *arcs_; }

private:
    std::shared_ptr<const Corners> corners_;
    std::shared_ptr<const ArcGraph> arcs_;
};

//! Propagates distances from all sites at once.
//!
//! \param sites  surface points, each a site if options.points says nothing else; several may share
//!               a face or even a position (the least start, then the lower index owns it). A point
//!               on a line or in a region of options.shapes that starts no later owns nothing. May
//!               be empty if there are shapes.
//! \throw InvalidOption    an option is out of range, or the engine cannot do what it asks.
//! \throw InvalidSites     a site names a face that does not exist or has coordinates off the face,
//!                         has no point; a site or a shape starts at a distance that is out of
//!                         range; a shape is empty, or names an edge or a face that does not
//!                         exist.
//! \throw ConstraintUnmet  the Steiner engine cannot meet max_error.
//! \throw Cancelled        the progress callback returned false.
//! Re-entrant.
[[nodiscard]] Propagation propagate(const Surface& surface, std::span<const SurfacePoint> sites,
                                    const PropagationOptions& options = {});

//! The same for a surface whose layout exists already. The Steiner engine does not use it. A layout
//! that is moved here is freed as soon as it has been used: it is larger than the surface.
[[nodiscard]] Propagation propagate(const Surface& surface, SurfaceLayout layout,
                                    std::span<const SurfacePoint> sites,
                                    const PropagationOptions& options = {});

}  // namespace agvd
