! RAPID Kernel, Reserved words: they name nothing.
MODULE reserved_words
  VAR num step:=1;              ! error: E121
  VAR num steps:=1;
  VAR num end:=2;
ENDMODULE
