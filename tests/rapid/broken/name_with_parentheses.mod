! Field practice, Broken shapes: a name with parentheses in it.
MODULE name_with_parentheses
  PERS tooldata Gripper(Closed):=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]]; ! error: E122

  PROC main()
    TPWrite "still read";
  ENDPROC
ENDMODULE
