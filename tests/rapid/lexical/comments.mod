! RAPID Kernel, Comments: from ! to the end of the line, wherever a blank may stand.
MODULE comments ! beside the head
  ! between declarations
  VAR num n:=1;           ! a comment may hold anything: "quotes", ; and ENDMODULE

  PROC main()
    n:=1+                 ! in the middle of an expression
      2;
    TPWrite "n is"        ! -> n is3
      \Num:=n;            ! a comment between arguments
    TPWrite "not ! here"; ! -> not ! here
    !!! a banner !!!
  ENDPROC
ENDMODULE
