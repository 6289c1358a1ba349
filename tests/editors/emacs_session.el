;;; emacs_session.el --- What a user of Emacs sees: findings, hover, rename; as JSON to $RESULT -*- lexical-binding: t -*-

(require 'rapid)
(require 'json)
(require 'flymake)

(defun wait-for (what condition)
  (with-timeout (30 (error "No %s after 30 s" what))
    (while (not (funcall condition)) (accept-process-output nil 0.05))))

(defun at (text)
  (goto-char (point-min))
  (search-forward text)
  (goto-char (match-beginning 0)))

(defvar seen nil)

(condition-case problem
    (progn
      (setq eglot-sync-connect 30)
      (find-file (car command-line-args-left))
      ;; Commands of a user run this hook, from which `eglot-ensure' connects.
      (run-hooks 'post-command-hook)
      (wait-for "server" (lambda () (eglot-current-server)))
      (push (cons 'mode (symbol-name major-mode)) seen)
      (flymake-start)
      (wait-for "findings" #'flymake-diagnostics)
      (push (cons 'findings
                  (vconcat (mapcar (lambda (one) (vector (line-number-at-pos (flymake-diagnostic-beg one))
                                                         (flymake-diagnostic-text one)))
                                   (flymake-diagnostics))))
            seen)
      (at "pHome, v500")
      (push (cons 'hover (plist-get (plist-get (jsonrpc-request (eglot-current-server) :textDocument/hover
                                                                (eglot--TextDocumentPositionParams))
                                               :contents)
                                    :value))
            seen)
      (at "pHome, v500")
      (eglot-rename "pRest")
      (push (cons 'text (buffer-substring-no-properties (point-min) (point-max))) seen)
      (at "pRest, v500")
      (call-interactively #'xref-find-definitions)
      (push (cons 'definition (line-number-at-pos)) seen)
      (push (cons 'comment comment-start) seen)
      (set-buffer-modified-p nil)
      (eglot-shutdown (eglot-current-server)))
  (error (push (cons 'problem (error-message-string problem)) seen)))

(with-temp-file (getenv "RESULT") (insert (json-encode seen)))
(kill-emacs 0)
