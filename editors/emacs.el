;;; rapid.el --- RAPID in Emacs 26 or later, with eglot -*- lexical-binding: t -*-

;; Copy to a folder of `load-path' and add (require 'rapid) to your init file.
;; Needs `pip install "rapidsim[edit]"' in a place that is in `exec-path'.

(require 'eglot)

(defvar rapid-words
  '("MODULE" "ENDMODULE" "PROC" "ENDPROC" "FUNC" "ENDFUNC" "TRAP" "ENDTRAP" "RECORD" "ENDRECORD"
    "ALIAS" "LOCAL" "TASK" "VAR" "PERS" "CONST" "IF" "THEN" "ELSEIF" "ELSE" "ENDIF" "FOR" "FROM"
    "TO" "STEP" "DO" "ENDFOR" "WHILE" "ENDWHILE" "TEST" "CASE" "DEFAULT" "ENDTEST" "RETURN" "RAISE"
    "RETRY" "TRYNEXT" "EXIT" "GOTO" "CONNECT" "WITH" "ERROR" "UNDO" "BACKWARD" "TRUE" "FALSE"))

(define-derived-mode rapid-mode prog-mode "RAPID"
  "Programs of ABB robots."
  (setq-local comment-start "! ")
  (setq-local comment-start-skip "!+ *")
  (setq-local case-fold-search t)
  (setq-local font-lock-defaults `((,(regexp-opt rapid-words 'words)) nil t))
  (modify-syntax-entry ?! "<")
  (modify-syntax-entry ?\n ">")
  (modify-syntax-entry ?\\ "."))

(add-to-list 'auto-mode-alist '("\\.\\(mod\\|modx\\|sys\\|sysx\\|prg\\)\\'" . rapid-mode))
(add-to-list 'eglot-server-programs '(rapid-mode . ("rapidsim" "lsp")))
(add-hook 'rapid-mode-hook #'eglot-ensure)

(provide 'rapid)
;;; rapid.el ends here
