#include "remesh/meshfile/packed.h"

#include <gtest/gtest.h>

#include "agvd/core/error.h"
#include "agvd/core/progress.h"
#include "remesh/meshfile/numbers.h"

using agvd::IoError;

namespace {

class Zip : public testing::Test {
protected:
    void SetUp() override {
        if (!remesh::knows_gzip()) GTEST_SKIP() << "built without zlib";
    }
};

// A file of one stored part, written by hand.
struct StoredPart {
    std::string name = "a.txt", content = "some text";
    std::uint16_t flags = 0, method = 0;
    bool is_large = false;  // The numbers of the directory have eight bytes.

    [[nodiscard]] std::string file() const {
        std::string fields;
        for (const std::uint16_t field :
             {std::uint16_t{20}, flags, method, std::uint16_t{0}, std::uint16_t{0}}) {
            remesh::append(fields, field);
        }
        remesh::append(fields, remesh::crc32_of(content));
        const auto size = static_cast<std::uint32_t>(content.size());
        const std::uint32_t shown = is_large ? 0xFFFFFFFF : size;
        std::string extra;
        if (is_large) {
            for (const int field : {9, 2, 0, 1, 24}) {
                remesh::append(extra, static_cast<std::uint16_t>(field));
            }
            for (const std::uint64_t number : {size, size, 0u}) remesh::append(extra, number);
        }
        std::string bytes = "PK\3\4" + fields;
        remesh::append(bytes, size);
        remesh::append(bytes, size);
        remesh::append(bytes, static_cast<std::uint16_t>(name.size()));
        remesh::append(bytes, std::uint16_t{3});
        bytes += name + "xyz" + content;
        const std::size_t begin = bytes.size();
        bytes += "PK\1\2" + std::string(2, '\0') + fields;
        remesh::append(bytes, shown);
        remesh::append(bytes, shown);
        remesh::append(bytes, static_cast<std::uint16_t>(name.size()));
        remesh::append(bytes, static_cast<std::uint16_t>(extra.size()));
        remesh::append(bytes, std::uint16_t{2});
        bytes += std::string(8, '\0');
        remesh::append(bytes, is_large ? 0xFFFFFFFFu : 0u);
        bytes += name + extra + "!?";
        const std::size_t directory_size = bytes.size() - begin;
        if (is_large) {
            const std::size_t large_end = bytes.size();
            bytes += "PK\6\6" + std::string(36, '\0');
            for (const std::uint64_t number : {directory_size, begin})
                remesh::append(bytes, number);
            bytes += "PK\6\7" + std::string(4, '\0');
            remesh::append(bytes, std::uint64_t{large_end});
            remesh::append(bytes, std::uint32_t{1});
        }
        bytes += "PK\5\6" + std::string(8, '\0');
        remesh::append(bytes, is_large ? 0xFFFFFFFF : static_cast<std::uint32_t>(directory_size));
        remesh::append(bytes, is_large ? 0xFFFFFFFF : static_cast<std::uint32_t>(begin));
        return bytes + std::string("\4\0rest", 6);
    }
};

std::string part_of(const std::string& bytes, const std::string& name) {
    remesh::SourceFile file{.path = "a.zip", .bytes = bytes};
    return remesh::ZipArchive(file).read(name).bytes;
}

void expect_zip_refused(const std::string& bytes, const char* what) {
    try {
        static_cast<void>(part_of(bytes, "a.txt"));
        ADD_FAILURE() << "read without complaint";
    } catch (const IoError& error) {
        EXPECT_EQ(std::string(error.what()).find("a.zip: byte "), 0u) << error.what();
        EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
        EXPECT_TRUE(std::string(error.what()).find(';') != std::string::npos ||
                    std::string(error.what()).find(": save") != std::string::npos)
            << error.what();
    }
}

std::string written(const std::string& content) {
    agvd::Ticker ticker;
    return remesh::pack_zip({{"b.txt", "other"}, {"a.txt", content}}, ticker);
}

}  // namespace

TEST_F(Zip, StoredAndLargePartsAreRead) {
    EXPECT_EQ(part_of(StoredPart{}.file(), "a.txt"), "some text");
    EXPECT_EQ(part_of(StoredPart{.is_large = true}.file(), "A.TXT"), "some text");
    EXPECT_EQ(part_of(StoredPart{.content = ""}.file(), "a.txt"), "");
}

TEST_F(Zip, WhatWasWrittenComesBack) {
    for (const std::string& content :
         {std::string("a"), std::string(9'000'000, 'x'), std::string()}) {
        EXPECT_EQ(part_of(written(content), "a.txt"), content);
        EXPECT_EQ(part_of(written(content), "B.txt"), "other");
    }
}

TEST_F(Zip, FilesThatEndEarlyAreRefused) {
    for (const std::string& bytes : {StoredPart{.is_large = true}.file(), written("some text")}) {
        const std::size_t end = bytes.rfind("PK\5\6") + 22;
        for (std::size_t size = 2; size < end; ++size) {
            EXPECT_THROW(static_cast<void>(part_of(bytes.substr(0, size), "a.txt")), IoError)
                << size;
        }
    }
}

TEST_F(Zip, DamagedPartsAreRefused) {
    const std::string good = StoredPart{}.file();
    std::string damaged = good;
    damaged[good.find("some")] = 'S';
    expect_zip_refused(damaged, "'a.txt' is damaged");
    expect_zip_refused(StoredPart{.name = "b.txt"}.file(), "no part 'a.txt'");
    expect_zip_refused(StoredPart{.flags = 1}.file(), "encrypted");
    expect_zip_refused(StoredPart{.method = 12}.file(), "method 12");
    expect_zip_refused(StoredPart{.method = 8}.file(), "damaged");
    for (const std::size_t field : {12u, 16u}) {  // Size and begin of the directory.
        std::string bytes = good;
        bytes.replace(good.rfind("PK\5\6") + field, 4, 4, '\x7f');
        expect_zip_refused(bytes, "truncated or damaged");
    }
    const std::size_t entry = good.find("PK\1\2");
    for (const std::size_t field : {20u, 24u, 42u}) {  // Both sizes, and where the part begins.
        std::string bytes = good;
        bytes.replace(entry + field, 4, 4, '\x7f');
        expect_zip_refused(bytes, "damaged");
    }
    std::string twice = good;
    const std::size_t end = good.rfind("PK\5\6");
    const std::string directory = good.substr(entry, end - entry);
    twice.insert(end, directory);
    twice[end + directory.size() + 12] = static_cast<char>(2 * directory.size());
    expect_zip_refused(twice, "two parts");
}

// The announced size is small; then it is right, and the callback stops.
TEST_F(Zip, AHugeContentIsStopped) {
    std::string bytes = written(std::string(100'000'000, '\0'));
    EXPECT_LT(bytes.size(), 200'000u);
    int num_polls = 0;
    const agvd::Progress stop = [&](double) { return ++num_polls < 5; };
    agvd::Poller poller(stop);
    remesh::SourceFile file{.path = "a", .bytes = bytes, .ticker = agvd::Ticker(poller)};
    EXPECT_THROW(static_cast<void>(remesh::ZipArchive(file).read("a.txt")), agvd::Cancelled);
    bytes.replace(bytes.rfind("PK\1\2") + 24, 4, std::string("\x10\0\0\0", 4));
    expect_zip_refused(bytes, "'a.txt' is damaged");
}
