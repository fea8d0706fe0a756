#pragma once
// Help of the open step beside the page: the pages of docs/help, which are part of the program and need no network.
// From its foot to the list of keys and to the parts of the program with their licences.

#include <QFrame>

class QLabel;
class QPushButton;
class QTextBrowser;

namespace zerodrift::ui {

class HelpPanel : public QFrame {
  Q_OBJECT

 public:
  explicit HelpPanel(QWidget* parent = nullptr);
  /// The help of this page; false when there is none.
  bool open(const QString& pageId);
  QString pageId() const { return m_pageId; }
  QString text() const;
  void retranslate();

 Q_SIGNALS:
  void closeRequested();
  void pageWanted(const QString& pageId);

 protected:
  void changeEvent(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void load();

  QString m_pageId;
  QLabel* m_title;
  QPushButton* m_close;
  QPushButton* m_keys;
  QPushButton* m_about;
  QTextBrowser* m_text;
};

}  // namespace zerodrift::ui
