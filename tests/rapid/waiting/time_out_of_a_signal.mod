! RAPID Instructions, WaitDI: \MaxTime with \TimeFlag is no error.
MODULE time_out_of_a_signal
  VAR signaldi diNever;
  VAR bool late;
  VAR clock watch;

  PROC main()
    AliasIO "diNever",diNever;
    ClkStart watch;
    WaitDI diNever,1\MaxTime:=0.75\TimeFlag:=late;
    TPWrite "late "\Bool:=late;         ! -> late TRUE
    TPWrite "after "\Num:=ClkRead(watch);        ! -> after 0.75
  ENDPROC
ENDMODULE
