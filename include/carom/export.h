// What a shared library shows of itself, and the namespace of these headers.
#pragma once

#if defined(CAROM_STATIC)
#define CAROM_API
#else
#define CAROM_API __attribute__((visibility("default")))
#endif

// Users write carom::Scene; the symbols are those of carom::v1, so that a later, different library
// can be loaded beside this one. Inside the library the names have to be told from its own.
#if defined(CAROM_BUILDING_LIBRARY)
#define CAROM_NAMESPACE_BEGIN \
    namespace carom {         \
    namespace v1 {
#else
#define CAROM_NAMESPACE_BEGIN \
    namespace carom {         \
    inline namespace v1 {
#endif
#define CAROM_NAMESPACE_END \
    }                       \
    }
