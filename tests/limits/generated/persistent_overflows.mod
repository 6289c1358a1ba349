MODULE Overflow
  ! A persistent may end as no number that a declaration could give it.
  PERS dnum large:=1.7E308;
  PROC main()
    Add large,large;
    TPWrite "large: "\Dnum:=large;
  ENDPROC
ENDMODULE
