//! \file
//! A separate folder for each test, with helpers to put files there.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/process.h"

class Scratch : public testing::Test {
protected:
    Scratch() {
        std::string name = std::filesystem::temp_directory_path() / "agvd-test-XXXXXX";
        folder_ = mkdtemp(name.data());
    }
    ~Scratch() override { std::filesystem::remove_all(folder_); }

    //! Path of a file in the folder.
    [[nodiscard]] std::string at(const std::string& name) const { return folder_ / name; }

    std::string put(const std::string& name, const std::string& bytes) const {
        std::ofstream(at(name), std::ios::binary) << bytes;
        return at(name);
    }
    std::string put(const std::string& name, const agvd::TriangleMesh& mesh) const {
        remesh::write_mesh(at(name), mesh.view());
        return at(name);
    }
    [[nodiscard]] std::string bytes(const std::string& name) const {
        std::ifstream file(at(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    [[nodiscard]] std::size_t num_files() const {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(folder_), {}));
    }

    //! Runs the program with these arguments.
    [[nodiscard]] static process::Outcome run(const char* program,
                                              std::vector<std::string> arguments,
                                              const process::Options& options = {}) {
        arguments.insert(arguments.begin(), program);
        return process::run(arguments, options);
    }

private:
    std::filesystem::path folder_;
};
