// Preloaded into the program, this makes the system short of something (see faults.py):
// FAIL_THREAD=3 fails the third thread that is made, 3+ that and all after it;
// FAIL_LIBRARY=avcodec,EGL fails to load the libraries whose names hold one of these words.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

static int made;

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument) {
    const char *wanted = getenv("FAIL_THREAD");
    if (wanted) {
        const int number = __atomic_add_fetch(&made, 1, __ATOMIC_SEQ_CST), first = atoi(wanted);
        if (number == first || (number > first && strchr(wanted, '+'))) return EAGAIN;
    }
    int (*real)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *) = dlsym(RTLD_NEXT, "pthread_create");
    return real(thread, attributes, start, argument);
}

void *dlopen(const char *name, int flags) {
    void *(*real)(const char *, int) = dlsym(RTLD_NEXT, "dlopen");
    const char *words = getenv("FAIL_LIBRARY");
    while (words && *words && name) {
        char word[64] = "";
        const size_t length = strcspn(words, ",");
        strncpy(word, words, length < sizeof word ? length : sizeof word - 1);
        if (strstr(name, word)) return real("/nowhere/lost.so", flags);
        words += length + (words[length] == ',');
    }
    return real(name, flags);
}
