//! \file
//! All of libremesh that users need, but for meshes of OpenMesh (remesh/io/openmesh_exchange.h) and
//! CGAL (remesh/adapt/face_graph.h).
#pragma once

#include "remesh/clean/clean_input.h"
#include "remesh/dual/build_dual.h"
#include "remesh/io/read_diagram.h"
#include "remesh/io/read_edges.h"
#include "remesh/io/read_mesh.h"
#include "remesh/io/read_sites.h"
#include "remesh/io/read_vertices.h"
#include "remesh/io/report.h"
#include "remesh/io/transfer_attributes.h"
#include "remesh/io/write_diagram.h"
#include "remesh/io/write_mesh.h"
#include "remesh/pipeline/expected_work.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "remesh/quality/self_intersections.h"
#include "remesh/relax/relax_sites.h"
#include "remesh/sampling/sample_sites.h"
#include "remesh/transfer/map_to_input.h"
#include "remesh/transfer/texture_seams.h"
#include "remesh/transfer/transfer_corners.h"
#include "remesh/transfer/transfer_values.h"
#include "remesh/transfer/vertex_normals.h"
