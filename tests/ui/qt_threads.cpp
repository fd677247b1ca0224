// Declares to ThreadSanitizer the synchronization through Qt, which is built without it: writes
// before a posted call, or before the start of a job, are visible when it runs. The linker puts
// these functions in place of Qt's (--wrap); they forward the calls.
#include <QMetaObject>
#include <QThreadPool>

#include <functional>
#include <sanitizer/tsan_interface.h>
#include <utility>

// The names that the linker requires for Qt's mangled names.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" {
bool __real__ZN11QMetaObject16invokeMethodImplEP7QObjectPN9QtPrivate15QSlotObjectBaseEN2Qt14ConnectionTypeEPv(
    QObject* object, QtPrivate::QSlotObjectBase* slot, Qt::ConnectionType type, void* result);
bool __wrap__ZN11QMetaObject16invokeMethodImplEP7QObjectPN9QtPrivate15QSlotObjectBaseEN2Qt14ConnectionTypeEPv(
    QObject* object, QtPrivate::QSlotObjectBase* slot, Qt::ConnectionType type, void* result)
{
    __tsan_release(object);
    return __real__ZN11QMetaObject16invokeMethodImplEP7QObjectPN9QtPrivate15QSlotObjectBaseEN2Qt14ConnectionTypeEPv(
        object, slot, type, result);
}

void __real__ZN11QThreadPool5startESt8functionIFvvEEi(QThreadPool* pool,
                                                      std::function<void()> job,
                                                      int priority);
void __wrap__ZN11QThreadPool5startESt8functionIFvvEEi(QThreadPool* pool,
                                                      std::function<void()> job,
                                                      int priority)
{
    __tsan_release(pool);
    __real__ZN11QThreadPool5startESt8functionIFvvEEi(
        pool,
        [pool, job = std::move(job)]() mutable {
            __tsan_acquire(pool);
            job();
            job = nullptr;
            __tsan_release(pool);
        },
        priority);
}

bool __real__ZN11QThreadPool11waitForDoneEi(QThreadPool* pool, int wait_ms);
bool __wrap__ZN11QThreadPool11waitForDoneEi(QThreadPool* pool, int wait_ms)
{
    const bool is_done = __real__ZN11QThreadPool11waitForDoneEi(pool, wait_ms);
    __tsan_acquire(pool);
    return is_done;
}

void __real__ZN11QThreadPoolD1Ev(QThreadPool* pool);
void __wrap__ZN11QThreadPoolD1Ev(QThreadPool* pool)
{
    __real__ZN11QThreadPoolD1Ev(pool);
    __tsan_acquire(pool);
}
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace {

// Called before every event that an object receives.
bool acquireOf(void** receiver_event_result)
{
    __tsan_acquire(receiver_event_result[0]);
    return false; // Qt delivers it
}

[[maybe_unused]] const bool kIsRegistered =
    QInternal::registerCallback(QInternal::EventNotifyCallback, acquireOf);

} // namespace
