! RAPID Kernel, Basic elements: line ends are blanks; only a comment ends with its line.
MODULE
  free_format
  VAR
    num
    n:=1;  VAR num m:=2;

  PROC main ( )
    n := n + m ; m := n ;	TPWrite ValToStr ( m ) ; ! -> 3
    IF n = 3 THEN TPWrite "three"; ELSE TPWrite "other"; ENDIF ! -> three
    TPWrite                          ! -> spread out3
      "spread "
      + "out"
      \Num
        := n;
    told
      n;
    Incr
      n;
    told n;
  ENDPROC
  PROC told(num x)
    TPWrite "told "\Num:=x;          ! -> told 3 ! -> told 4
  ENDPROC ENDMODULE
