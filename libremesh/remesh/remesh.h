//! \file
//! All of libremesh that users need, but for meshes of OpenMesh
//! (remesh/meshfile/openmesh_exchange.h) and CGAL (remesh/meshfile/face_graph.h).
#pragma once

#include "agvd/mesh/mesh.h"
#include "remesh/clean/clean_input.h"
#include "remesh/dual/build_dual.h"
#include "remesh/meshfile/read_diagram.h"
#include "remesh/meshfile/read_edges.h"
#include "remesh/meshfile/read_mesh.h"
#include "remesh/meshfile/read_sites.h"
#include "remesh/meshfile/read_vertices.h"
#include "remesh/meshfile/texture_seams.h"
#include "remesh/meshfile/write_diagram.h"
#include "remesh/meshfile/write_mesh.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "remesh/quality/self_intersections.h"
#include "remesh/sites/relax_sites.h"
#include "remesh/sites/sample_sites.h"
#include "remesh/transfer/map_to_input.h"
#include "remesh/transfer/transfer_attributes.h"
#include "remesh/transfer/transfer_corners.h"
#include "remesh/transfer/transfer_values.h"
