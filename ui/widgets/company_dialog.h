#pragma once
// Whose report it is: the logo and address of the company that made it, kept on this computer for every report.

#include <QDialog>
#include <QImage>

class QLabel;
class QPlainTextEdit;
class QPushButton;

namespace zerodrift::ui {

struct Company {
  QString address{};  // lines: name, street, town, telephone
  QImage logo{};      // null: none
};

class CompanyDialog : public QDialog {
  Q_OBJECT

 public:
  explicit CompanyDialog(const Company& company, QWidget* parent = nullptr);
  Company company() const;
  /// Reads a picture, made as small as a logo need be; false, with the reason on the dialog: it is none.
  bool takeLogo(const QString& path);

 private:
  void chooseLogo();
  void showLogo();

  QImage m_logo;
  QPlainTextEdit* m_address;
  QLabel* m_picture;
  QLabel* m_problem;
  QPushButton* m_remove;
};

}  // namespace zerodrift::ui
