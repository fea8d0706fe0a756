#include "app/tasks/task_runner.h"

#include <QSignalSpy>
#include <QTest>
#include <atomic>
#include <future>
#include <vector>

#include "app/tasks/aside.h"

namespace zerodrift {

class TaskRunnerTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void aThrownExceptionEndsTheWorkAndNotTheProgram() {
    TaskRunner runner;
    std::optional<ErrorCode> code;
    QVERIFY(runner.start<int>(
        "thrower", [](const TaskContext&) -> Result<int> { return std::vector<int>(1).at(7); },
        [&](const Result<int>& result) { code = result.error().code; }));
    QTRY_VERIFY(code.has_value());
    QCOMPARE(*code == ErrorCode::internal, true);
    QVERIFY(!runner.running());
  }

  void whatEndsSlowlyEndsAside() {
    struct Slow {
      std::shared_future<void> allowed;
      std::atomic<bool>& gone;
      ~Slow() {
        allowed.wait();
        gone = true;
      }
    };
    std::promise<void> allow;
    std::atomic<bool> gone = false;
    {
      Aside aside;
      aside.drop(std::shared_ptr<Slow>(new Slow{allow.get_future().share(), gone}));
      QVERIFY(!gone);  // whoever drops it does not wait for its end
      allow.set_value();
    }
    QVERIFY(gone);
  }

  void givesTheResultOnItsOwnThread() {
    TaskRunner runner;
    std::optional<int> answer;
    const auto here = std::this_thread::get_id();
    bool sameThread = false;
    QVERIFY(runner.start<int>(
        "sum", [](const TaskContext&) -> Result<int> { return 42; },
        [&](const Result<int>& result) {
          answer = result.value();
          sameThread = std::this_thread::get_id() == here;
        }));
    QVERIFY(runner.running());
    QVERIFY(!runner.start<int>(
        "second", [](const TaskContext&) -> Result<int> { return 0; }, [](const Result<int>&) {}));
    QTRY_VERIFY(answer.has_value());
    QCOMPARE(*answer, 42);
    QVERIFY(sameThread);
    QVERIFY(!runner.running());
  }

  void cancelEndsWithAnError() {
    TaskRunner runner;
    std::optional<ErrorCode> code;
    runner.start<int>(
        "long",
        [](const TaskContext& context) -> Result<int> {
          while (!context.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
          return fail(ErrorCode::cancelled);
        },
        [&](const Result<int>& result) { code = result.error().code; });
    runner.cancel();
    QTRY_VERIFY(code.has_value());
    QCOMPARE(*code, ErrorCode::cancelled);
  }

  void progressIsThinned() {
    TaskRunner runner;
    QSignalSpy spy(&runner, &TaskRunner::progressed);
    bool done = false;
    runner.start<int>(
        "many",
        [](const TaskContext& context) -> Result<int> {
          for (int i = 0; i < 100000; ++i) context.progress(i / 100000.0);
          return 1;
        },
        [&](const Result<int>&) { done = true; });
    QTRY_VERIFY(done);
    QVERIFY(spy.count() >= 1);
    QVERIFY(spy.count() < 100);
  }
};

}  // namespace zerodrift

QTEST_GUILESS_MAIN(zerodrift::TaskRunnerTest)
#include "task_runner_test.moc"
