//! \file
//! All of libremesh that users need, but for meshes of OpenMesh
//! (remesh/meshfile/openmesh_exchange.h) and CGAL (remesh/meshfile/face_graph.h).
#pragma once

#include "agvd/mesh/mesh.h"
#include "remesh/clean/clean_input.h"
#include "remesh/dual/build_dual.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/read_mesh.h"
#include "remesh/meshfile/read_sites.h"
#include "remesh/meshfile/write_mesh.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/relax_sites.h"
#include "remesh/sites/sample_sites.h"
#include "remesh/transfer/transfer.h"
