#pragma once
// The states of a transaction as a list that fills: waiting, running, done, failed, skipped. Each with a word.

#include <QString>
#include <QVector>
#include <QWidget>

namespace zerodrift::ui {

enum class StageState {
  waiting,
  running,
  done,
  failed,
  skipped,
};

struct Stage {
  QString text{};
  StageState state = StageState::waiting;
  QString detail{};  // "412 registers, CRC 8F21", or what failed
};

class StepList : public QWidget {
  Q_OBJECT

 public:
  explicit StepList(QWidget* parent = nullptr);
  void setStages(const QVector<Stage>& stages);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QVector<Stage> m_stages;
};

}  // namespace zerodrift::ui
