//! \file
//! All of libremesh that users need, but for meshes of OpenMesh
//! (remesh/meshfile/openmesh_exchange.h) and CGAL (remesh/meshfile/face_graph.h).
#pragma once

#include "agvd/mesh/mesh.h"
#include "remesh/clean/clean_input.h"
#include "remesh/dual/build_dual.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/sites.h"
#include "remesh/transfer/transfer.h"
