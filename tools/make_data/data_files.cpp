#include "make_data/data_files.h"

namespace make_data {

const std::vector<DataFile>& data_files() {
    static const std::vector<DataFile> files{{"organic.ply", organic}, {"part.off", part},
                                             {"shell.obj", shell},     {"plate.stl", plate},
                                             {"parts.ply", parts},     {"slivers.off", slivers}};
    return files;
}

}  // namespace make_data
