// What the race's child processes share: meshes and lists over pipes, and the clock. One thread.
// All numbers are in the machine's byte order. A mesh is
//   u32 vertices, f32 [vertices][3], u32 triangles, u32 [triangles][3]

#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

struct Point {
    float x, y, z;
};

struct Triangle {
    uint32_t corners[3];
};

struct Mesh {
    std::vector<Point> vertices;
    std::vector<Triangle> triangles;
};

// False where the input ends.
template <typename T> bool read(T &number) {
    return std::fread(&number, sizeof number, 1, stdin) == 1;
}

template <typename T> void read(std::vector<T> &items, size_t count) {
    items.resize(count);
    if (std::fread(items.data(), sizeof(T), count, stdin) != count) std::exit(2);
}

inline Mesh read_mesh() {
    Mesh mesh;
    uint32_t count = 0;
    if (!read(count)) std::exit(2);
    read(mesh.vertices, count);
    if (!read(count)) std::exit(2);
    read(mesh.triangles, count);
    return mesh;
}

template <typename T> void write(const T *items, size_t count) {
    if (std::fwrite(items, sizeof(T), count, stdout) != count) std::exit(3);
}

// Of this process, as the race measures the others.
inline double processor_seconds() {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

// Reads a list of queries and answers each: first the seconds that all took.
template <typename Query, typename Answer, typename Ask> void answer(uint32_t count, Ask ask) {
    std::vector<Query> queries;
    read(queries, count);
    std::vector<Answer> answers(count);
    double begun = processor_seconds();
    for (uint32_t i = 0; i < count; i++) answers[i] = ask(queries[i]);
    double seconds = processor_seconds() - begun;
    write(&seconds, 1);
    write(answers.data(), count);
    std::fflush(stdout);
}
