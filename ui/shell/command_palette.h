#pragma once
// Ctrl+K: finds any step, sensor or action by a few letters.

#include <QString>
#include <QVector>
#include <QWidget>

class QFrame;
class QLineEdit;
class QListWidget;

namespace zerodrift::ui {

struct Command {
  QString id{};
  QString text{};   // "Open Warm-up"
  QString group{};  // "Step", "Sensor", "Action"
  QString hint{};   // shortcut, value, or the reason why it is off
  bool enabled = true;
};

/// How well the letters of the search fit a text, in order; negative: not at all.
int matchScore(const QString& search, const QString& text);

class CommandPalette : public QWidget {
  Q_OBJECT

 public:
  explicit CommandPalette(QWidget* parent);
  void open(const QVector<Command>& commands);

 Q_SIGNALS:
  void chosen(const QString& id);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  void filter();
  void choose();

  QVector<Command> m_commands;
  QFrame* m_box;
  QLineEdit* m_search;
  QListWidget* m_list;
};

}  // namespace zerodrift::ui
