// A fuzz target: what is done with one input. libFuzzer calls it (scripts/fuzz.sh), and so does
// replay.cpp, which needs no special compiler.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace carom::fuzz {

/// What the input was. A finding ends the process: by a signal, a sanitizer's report, or
/// broken_promise().
using Target = void (*)(std::string_view input);

/// Says which promise the input broke, and aborts.
[[noreturn]] void broken_promise(const std::string& what);

/// A file in a folder of this process, for readers that take paths: the same one each time, with
/// new content. `extension` with its dot.
std::string file_with(std::string_view content, const std::string& extension);

/// The path of another file in that folder.
std::string file_beside(const std::string& name, std::string_view content);

/// Makes a target known to replay.cpp.
struct Registration {
    Registration(const char* name, Target target);
};

}  // namespace carom::fuzz

/// In carom::fuzz, in no other namespace: libFuzzer finds its entry by name.
#ifdef CAROM_LIBFUZZER
#define CAROM_FUZZ_TARGET(name)                                                         \
    static void name##_target(std::string_view);                                        \
    extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);  \
    extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) { \
        name##_target({reinterpret_cast<const char*>(data), size});                     \
        return 0;                                                                       \
    }                                                                                   \
    static void name##_target(std::string_view input)
#else
#define CAROM_FUZZ_TARGET(name)                                                       \
    static void name##_target(std::string_view);                                      \
    static const carom::fuzz::Registration name##_registration(#name, name##_target); \
    static void name##_target(std::string_view input)
#endif
