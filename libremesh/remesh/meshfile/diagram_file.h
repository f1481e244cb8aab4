//! \file
//! Files of sites, of edges and of diagrams: what is read back is what was written, bit for bit.
//! Held by ReadSites and WriteDiagram in tests/remesh/meshfile.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "agvd/core/progress.h"
#include "agvd/diagram/diagram.h"
#include "agvd/mesh/mesh.h"
#include "remesh/names.h"

namespace remesh {

//! A line along edges, or a region of faces, as a site or a part of one.
struct GivenShape {
    std::vector<std::array<Index, 2>> edges = {};  //!< Pairs of vertices of the mesh.
    std::vector<Index> faces = {};                 //!< Of the mesh.
    Index site = 0;                                //!< The site that it belongs to.
    double start = 0;                              //!< As SiteShape::start.

    //! Whether both say the same in the same words.
    friend bool operator==(const GivenShape&, const GivenShape&) = default;
};

//! What was read from a file of sites.
struct SitesFile {
    std::vector<SurfacePoint> sites;    //!< In the file's order.
    SitePoints points;                  //!< Sites of the points, and their starts.
    std::vector<GivenShape> shapes;     //!< Lines and regions, in the file's order.
    std::vector<std::string> warnings;  //!< With the file's name and the line.
};

//! Whether points at one place are a warning: of sites only one counts, of targets all do.
enum class Repeats { Told, Allowed };

//! A text file with one site per line, in the order of the result; indices count from 0, as in the
//! arrays of `mesh`:
//!
//!     # a comment, also behind a site
//!     v INDEX             a vertex
//!     f FACE B0 B1 B2     a point of a triangle by its barycentric coordinates
//!     p X Y Z             the nearest point of the mesh (the lowest face, if several are as near)
//!     l INDEX INDEX ...   a line along edges: vertices, each joined to the next one by an edge
//!     r FACE FACE ...     a region: triangles
//!
//! Behind each may stand `site N`, the site that it belongs to (on all lines, or on none: then
//! each line is a site), and `start D`, the distance that it starts with (0 where it is missing).
//! Whether vertices of a line are joined is not checked.
//!
//! FACE is a triangle of the mesh, or with face_polygon a face of the file: behind the coordinates
//! in a larger polygon stand the three vertices to which they belong, V0 V1 V2, as in lines of
//! --map. A vertex site lies in the lowest of its faces. Barycentric coordinates whose sum differs
//! from 1 by at most 1e-6 are scaled to it. Points that are off the mesh by more than a hundredth
//! of the sites' spacing (the square root of area / sites) are a warning, and so are sites that lie
//! exactly where earlier ones do.
//!
//! \param mesh  #V x 3 positions, finite; #F x 3 indices, in range; may be dirty otherwise.
//! \throw IoError       the file cannot be read, a line is none of these, only some lines have a
//!        `site`, or there is no site; the text names the file, the line and the remedy.
//! \throw InvalidInput  an index is out of range, a vertex is in no face, a coordinate is not
//!        finite, barycentric coordinates are negative or do not sum to 1, or a point is off the
//!        mesh by more than the spacing; names file and line.
//! Cost: O(file size + n log n), and O(#F log #F) once for the first `p`.
//! \param repeats  whether sites at the place of earlier ones are a warning.
//! \param face_polygon  MeshFile::face_polygon, or empty.
[[nodiscard]] SitesFile read_sites(const std::filesystem::path& path, const MeshView& mesh,
                                   const Progress& progress = {}, Repeats repeats = Repeats::Told,
                                   std::span<const Index> face_polygon = {});

//! A text file with one vertex per line, counted from 0 as in the arrays of read_mesh's result;
//! what follows # is a comment.
//!
//! \throw IoError  the file cannot be read, a line has another form, or there is no vertex.
//! \throw InvalidInput  the mesh has no such vertex, or it is in no face.
//!        Both name the file, the line and the remedy.
//! Cost: O(file size + #F).
[[nodiscard]] std::vector<Index> read_vertices(const std::filesystem::path& path,
                                               const MeshView& mesh, const Progress& progress = {});

//! A text file with two vertices per line, counted from 0 as in the arrays of read_mesh's result;
//! what follows # is a comment.
//!
//! \throw IoError  the file cannot be read, a line has another form, or there is no edge; the
//!        text names the file, the line and the remedy.
//! \throw InvalidInput  a number is beyond 64 bits.
//! Cost: O(file size).
[[nodiscard]] std::vector<std::array<Index, 2>> read_edges(const std::filesystem::path& path,
                                                           const Progress& progress = {});

//! A text file with two vertices and a length per line, in mesh units; what follows # is a comment.
//! Each edge of the mesh must have a length.
//!
//! \return #F x 3: of the side from corner k of a face to corner k + 1.
//! \throw IoError       the file cannot be read, or a line has another form.
//! \throw InvalidInput  a line names what is no edge of the mesh, or has a length that is not above
//!        0, or an edge has two lengths, or none.
//!        All name the file, the line or the edge, and the remedy.
//! Cost: O(file size + #F log #F).
[[nodiscard]] std::vector<double> read_edge_lengths(const std::filesystem::path& path,
                                                    const MeshView& mesh,
                                                    const Progress& progress = {});

//! What a file of `agvd diagram` holds.
struct DiagramFile {
    TriangleMesh mesh;                //!< On which the diagram lies.
    std::vector<SurfacePoint> sites;  //!< On the mesh; in the order of the cells if each is a site.
    SitePoints points;                //!< What they stand for.
    std::vector<GivenShape> shapes;   //!< Lines and regions among the sites.
    Diagram diagram;                  //!< With the points of its edges.
};

//! Returns the data given to write_diagram, bit for bit. Every index is in range; whether the
//! curves form a complex is not checked.
//!
//! \throw IoError       the file is missing, truncated or malformed, or holds no
//!                            diagram; the text names the file, the place and the remedy.
//! \throw InvalidInput  the file reads well but an index is out of range, a point is off its
//!                            face, or counts contradict each other.
//! \throw Cancelled     the progress callback returned false.
[[nodiscard]] DiagramFile read_diagram(const std::filesystem::path& path,
                                       const Progress& progress = {});

//! Writes the format of the extension (any case; compressed if .gz follows), to a temporary file
//! that is renamed:
//! - vtp: VTK XML PolyData of the surface's mesh as polygons, each Voronoi edge and each boundary
//!   arc of a cell as a polyline (a closed curve repeats its first point), and each site as a
//!   vertex. Point data `site` (of an edge's point: on its left) and `distance` from it, in mesh
//!   units; cell data `site_left`, `site_right` of the polylines (-1: outside the surface, which
//!   only a boundary arc has; -1 for all other cells). Of a diagram with arcs each arc is a
//!   polyline, with cell data `edge`, `kind` (0: line, 1: hyperbola, 2: chord; -1: no arc),
//!   `focus_left`, `focus_right` (in space) and `weight_left`, `weight_right`.
//! - ply: the surface's mesh as write_mesh writes it, with vertex properties `site` (int) and
//!   `distance` (double; where no site reaches, site is -1 and distance is infinity), and of a
//!   diagram with arcs an element `arc`, as BisectorArc.
//! - obj: the polylines as `v` and `l` lines, each preceded by a comment `# sites LEFT RIGHT`.
//! - agvd: everything, for read_diagram: such a PLY, and as elements of their own the sites and the
//!   complex. The header's comments explain them.
//!
//! \param sites   those that the diagram was built from: points; in .agvd with the shapes besides.
//! \param points  what they stand for.
//! \param shapes  of the surface; it has an edge once only between two vertices.
//! \throw IoError  the extension is unknown or the file cannot be written; says which and
//!        why.
//! \throw InvalidOption  .agvd of a surface that is given by lengths.
//! \throw Cancelled  the progress callback returned false; an old file is unchanged.
void write_diagram(const std::filesystem::path& path, const Surface& surface,
                   std::span<const SurfacePoint> sites, const Diagram& diagram,
                   const Progress& progress = {}, const SitePoints& points = {},
                   std::span<const SiteShape> shapes = {});

//! The bytes that write_diagram writes, for write_files_atomically.
//! \throw IoError, Cancelled  as write_diagram.
[[nodiscard]] std::string format_diagram(const std::filesystem::path& path, const Surface& surface,
                                         std::span<const SurfacePoint> sites,
                                         const Diagram& diagram, const Progress& progress = {},
                                         const SitePoints& points = {},
                                         std::span<const SiteShape> shapes = {});

//! \throw IoError  write_diagram does not know the extension; the text lists the known ones.
void check_diagram_extension(const std::filesystem::path& path);

}  // namespace remesh
