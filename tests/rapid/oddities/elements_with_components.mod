! Field practice, Variables: components of elements, elements by expressions.
MODULE elements_with_components
  VAR robtarget targets{3};
  VAR wobjdata tables{2}:=[[FALSE,TRUE,"",[[1,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]],
                           [FALSE,TRUE,"",[[2,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]]];
  VAR num i:=1;

  PROC main()
    targets{i+1}.trans.x:=5;
    targets{i*3}:=targets{2};
    targets{3}.trans:=targets{3}.trans+[1,1,1];
    TPWrite ValToStr(targets{3}.trans);           ! -> [6,1,1]
    tables{Round(1.6)}.uframe.trans.y:=tables{i}.uframe.trans.x;
    TPWrite ValToStr(tables{2}.uframe.trans);     ! -> [2,1,0]
  ENDPROC
ENDMODULE
