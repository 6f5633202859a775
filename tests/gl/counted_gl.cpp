#include "tests/gl/counted_gl.h"

#include <sys/mman.h>

#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>

#include "tests/gl/headless_context.h"

namespace seaglare::test {

namespace {

struct Counter {
    std::uint64_t calls = 0;
    void* code = nullptr;
};

std::map<std::string, std::unique_ptr<Counter>>& counters() {
    static std::map<std::string, std::unique_ptr<Counter>> all;
    return all;
}

constexpr std::size_t code_bytes = 32;
constexpr std::size_t most_functions = 2048;

// Room for another piece of code; never given back.
unsigned char* next_code() {
    static unsigned char* memory = nullptr;
    static std::size_t used = 0;
    if (memory == nullptr) {
        void* mapped = mmap(nullptr, code_bytes * most_functions, PROT_READ | PROT_WRITE | PROT_EXEC,
                            MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (mapped == MAP_FAILED) throw std::runtime_error("no executable memory");
        memory = static_cast<unsigned char*>(mapped);
    }
    if (used == most_functions) throw std::runtime_error("more GL functions than expected");
    return memory + code_bytes * used++;
}

}  // namespace

bool CountedGl::possible() {
#if defined(__x86_64__)
    return true;
#else
    return false;
#endif
}

void* CountedGl::get_proc(void* user, const char* name) {
    void* real = HeadlessContext::get_proc(user, name);
    if (real == nullptr) return nullptr;
    std::unique_ptr<Counter>& counter = counters()[name];
    if (counter != nullptr) return counter->code;
    counter = std::make_unique<Counter>();
    const std::uint64_t* address = &counter->calls;
    unsigned char* code = next_code();
    counter->code = code;
    // movabs r11, address; lock inc qword [r11]; movabs r11, real; jmp r11. The calling convention leaves r11 free.
    const unsigned char to_r11[] = {0x49, 0xBB}, increment[] = {0xF0, 0x49, 0xFF, 0x03},
                        jump[] = {0x41, 0xFF, 0xE3};
    const auto put = [&](const void* bytes, std::size_t size) {
        std::memcpy(code, bytes, size);
        code += size;
    };
    put(to_r11, sizeof to_r11);
    put(&address, sizeof address);
    put(increment, sizeof increment);
    put(to_r11, sizeof to_r11);
    put(&real, sizeof real);
    put(jump, sizeof jump);
    return counter->code;
}

void CountedGl::reset() {
    for (const auto& [name, counter] : counters())
        counter->calls = 0;
}

std::uint64_t CountedGl::calls() {
    std::uint64_t sum = 0;
    for (const auto& [name, counter] : counters())
        sum += counter->calls;
    return sum;
}

std::uint64_t CountedGl::calls_of(const std::string& name) {
    const auto found = counters().find(name);
    return found == counters().end() ? 0 : found->second->calls;
}

}  // namespace seaglare::test
